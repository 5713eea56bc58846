#include "mrpbench_local/costmap/update_buffers.hpp"

namespace mrpbench::local {

UpdateBuffers& UpdateBuffers::of_thread() {
  thread_local UpdateBuffers buffers;
  return buffers;
}

}  // namespace mrpbench::local
