#include "mrpbench_mapf/single_agent/distances.hpp"

namespace mrpbench::mapf {

Distances::Distances(int vertices, bool pages, Tick unit, Limits& limits) : unit_(unit) {
  const auto count = static_cast<std::size_t>(vertices);
  const std::size_t page_count = (count + kPage - 1) / kPage;
  bytes_ = pages ? page_count * sizeof(pages_[0]) : count * sizeof(Tick);
  limits.charge(bytes_);
  if (pages) {
    pages_.resize(page_count);
  } else {
    flat_.assign(count, kForever);
  }
}

Tick Distances::paged(int vertex) const {
  const Page* const page = pages_[static_cast<std::size_t>(vertex / kPage)].get();
  if (page == nullptr) return kForever;
  const auto at = static_cast<std::size_t>(vertex % kPage);
  if (page->wide) return (*page->wide)[at];
  return page->beyond[at] == kUnknown ? kForever : page->base + page->beyond[at] * unit_;
}

void Distances::set_paged(int vertex, Tick distance, Limits& limits) {
  std::unique_ptr<Page>& page = pages_[static_cast<std::size_t>(vertex / kPage)];
  if (!page) {
    limits.charge(sizeof(Page) + kHeader);
    bytes_ += sizeof(Page) + kHeader;
    page = std::make_unique<Page>();
    page->base = distance;
    page->beyond.fill(kUnknown);
  }
  const auto at = static_cast<std::size_t>(vertex % kPage);
  const Tick beyond = distance - page->base;
  if (!page->wide && beyond >= 0 && beyond % unit_ == 0 && beyond / unit_ < kUnknown) {
    page->beyond[at] = static_cast<std::uint8_t>(beyond / unit_);
    return;
  }
  if (!page->wide) widen(*page, limits);
  (*page->wide)[at] = distance;
}

void Distances::widen(Page& page, Limits& limits) {
  constexpr std::size_t kBytes = kPage * sizeof(Tick) + sizeof(std::vector<Tick>) + 2 * kHeader;
  limits.charge(kBytes);
  bytes_ += kBytes;
  auto wide = std::make_unique<std::vector<Tick>>(kPage, kForever);
  for (std::size_t at = 0; at < page.beyond.size(); ++at) {
    if (page.beyond[at] != kUnknown) (*wide)[at] = page.base + page.beyond[at] * unit_;
  }
  page.wide = std::move(wide);
}

}  // namespace mrpbench::mapf
