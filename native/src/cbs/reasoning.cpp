#include "mrpbench_mapf/cbs/reasoning.hpp"

namespace mrpbench::mapf {

void Reasoning::examine(const Situation& situation, Conflict& conflict) {
  if (conflict.examined) return;
  conflict.examined = true;
  if (!bench_.options.prioritize) return;
  const int rising = bench_.costs_more(situation, conflict.one, conflict.branch[0]) +
                     bench_.costs_more(situation, conflict.other, conflict.branch[1]);
  conflict.cardinality = static_cast<Conflict::Cardinality>(rising);
}

}  // namespace mrpbench::mapf
