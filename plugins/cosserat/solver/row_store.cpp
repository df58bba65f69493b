#include "plugins/cosserat/solver/row_store.h"

#include <algorithm>
#include <iterator>

#include "plugins/cosserat/lanes/lane_access.h"

namespace pedicel::cosserat {

namespace {

// Lanes without an element compute too: with unit masses and without stiffness nothing they do is
// ill-defined, or reaches anyone.
ElementRow empty_row() {
  ElementRow row{};
  for (int lane = 0; lane < lane_count; ++lane) {
    row.length[lane] = row.mass[lane] = row.rest_rotation[3][lane] = 1.0;
    put(row.inertia, lane, Vec3::Ones());
  }
  return row;
}

PoseRow identity_row() {
  PoseRow row{};
  for (double& w : row.orientation[3]) w = 1.0;
  return row;
}

ExtensionRow plain_row() {
  ExtensionRow row{};
  std::fill(std::begin(row.elastic), std::end(row.elastic), 1.0);
  return row;
}

BranchRow no_branch() {
  BranchRow row{};
  std::fill(std::begin(row.limit), std::end(row.limit), JointBranch::never);
  return row;
}

WeldRow no_weld() {
  WeldRow row{};
  for (double& w : row.rest_rotation[3]) w = 1.0;
  return row;
}

// What an element of a part with loops takes, where one of a tree takes 1.
constexpr double loop_cost = 2.0;

// Elements, the grain size: waking a thread takes as long as a step of fewer.
constexpr int grain_elements = 400;

TaskGraph graph_of(const LaneLayout& layout, std::span<const RodModel* const> plants, int threads) {
  std::vector<double> rows(layout.tasks(), 1.0);
  for (int p = 0; p < layout.packs(); ++p)
    rows[p] = (layout.loops(p) ? loop_cost : 1.0) * (layout.end_row(p) - layout.first_row(p));
  int elements = 0;
  for (const RodModel* const plant : plants) elements += plant->size();
  return {layout.needs(), rows, std::clamp(elements / grain_elements, 1, threads)};
}

}  // namespace

RowStore::RowStore(std::span<const RodModel* const> plants, int threads, bool keep_blocks,
                   std::shared_ptr<RowScratch> shared_scratch)
    : scratch(shared_scratch ? std::move(shared_scratch) : std::make_shared<RowScratch>()),
      layout(plants, keep_blocks),
      graph(graph_of(layout, plants, threads)),
      packs(layout.packs()),
      element(layout.rows(), empty_row(), scratch->memory),
      previous(layout.rows(), identity_row(), scratch->memory),
      previous_rate(layout.rows(), RateRow{}, scratch->memory),
      previous_strain(scratch->memory),
      first_branch(layout.rows(), -1),
      anchors(layout.packs()),
      carriers(layout.tasks()),
      clamps(plants.size(), std::vector<Clamp>(1)) {
  // The rows of one thread lie side by side, so that what its core fetches ahead is its own.
  std::vector<int> order;
  for (int thread = 0; thread < graph.threads(); ++thread)
    std::ranges::copy_if(graph.tasks_of(thread), std::back_inserter(order),
                         [&](int task) { return layout.is_pack(task); });
  layout.place(order);
  // Scratch may be shared: it has room for the largest of those that use it.
  const auto grow = [&](auto& rows) {
    if (static_cast<int>(rows.size()) < layout.rows()) rows.resize(layout.rows());
  };
  grow(scratch->start);
  grow(scratch->iterate);
  grow(scratch->rate);
  grow(scratch->term);
  grow(scratch->factor);
  for (std::size_t p = 0; p < plants.size(); ++p)
    if (layout.plant_keeps_blocks(static_cast<int>(p))) grow(scratch->blocks);
  make_packs();
  make_loops();
  join_chains();
}

// Lanes that nobody sets compute along, and must not divide by zero.
void RowStore::make_packs() {
  for (int p = 0; p < layout.packs(); ++p) {
    packs[p] = Pack{};
    packs[p].begin = layout.first_row(p);
    packs[p].end = layout.end_row(p);
    std::fill(std::begin(packs[p].effective_step), std::end(packs[p].effective_step), 1.0);
    std::fill(std::begin(packs[p].past_now), std::end(packs[p].past_now), 1.0);
    std::fill(std::begin(packs[p].modulus), std::end(packs[p].modulus), 1.0);
  }
}

void RowStore::make_loops() {
  std::size_t welds = 0, factors = 0;
  for (int p = 0; p < layout.packs(); ++p) {
    const LoopShape* const loops = layout.loops(p);
    packs[p].loops = loops;
    if (!loops) continue;
    packs[p].first_weld = static_cast<int>(welds);
    packs[p].first_loop_factor = static_cast<int>(factors);
    welds += loops->welds().size();
    factors += loops->entries().size();
  }
  weld.assign(welds, no_weld());
  if (scratch->loop_factor.size() < factors) scratch->loop_factor.resize(factors);
}

// From the last chain to the first, so that the sources of a row are taken in their order.
void RowStore::join_chains() {
  for (int c = static_cast<int>(layout.chains().size()) - 1; c >= 0; --c) {
    const Chain& chain = layout.chains()[c];
    anchors[chain.pack][chain.lane] = {chain.plant, chain.from, chain.elements.front()};
    if (chain.from < 0) continue;
    const Slot slot = layout.slot(chain.plant, chain.from);
    carriers[layout.task_of(layout.chains()[chain.parent].pack, slot.row)].push_back(
        {slot, {packs[chain.pack].begin, chain.lane}});
    if (layout.keeps_blocks(chain.pack)) continue;
    branches.push_back(
        {packs[chain.pack].branch[0] + chain.lane, lane_count, slot.lane, first_branch[slot.row]});
    first_branch[slot.row] = static_cast<int>(branches.size()) - 1;
  }
  for (std::vector<Carrier>& carried : carriers)
    std::ranges::sort(carried, std::ranges::less{}, [](const Carrier& c) { return c.element.row; });
}

RowArrays RowStore::arrays() {
  RowArrays rows;
  rows.element = element.data();
  rows.start = scratch->start.data();
  rows.iterate = scratch->iterate.data();
  rows.previous = previous.data();
  rows.rate = scratch->rate.data();
  rows.previous_rate = previous_rate.data();
  rows.strain = scratch->strain.data();
  rows.previous_strain = previous_strain.data();
  rows.viscous = scratch->viscous.data();
  rows.term = scratch->term.data();
  rows.factor = scratch->factor.data();
  rows.blocks = scratch->blocks.data();
  rows.weld = weld.data();
  rows.loop_factor = scratch->loop_factor.data();
  rows.first_branch = first_branch.data();
  rows.branches = branches.data();
  rows.extension = extension.data();
  rows.extension_term = extension_term.data();
  rows.law_branch = law_branch.data();
  rows.joint_term = joint_term.data();
  rows.law_branches = law_branches_a_row;
  rows.axis_share = axis_share;
  for (int i = 0; i < 3; ++i) rows.gravity[i] = gravity[i];
  rows.ahead = ahead;
  return rows;
}

// Packs that stay as they are are not written to: a thread has them in its core's cache.
void RowStore::set_active(std::span<const char> plants) {
  if (std::ranges::equal(plants, active_plants_)) return;
  active_plants_.assign(plants.begin(), plants.end());
  active_.assign(packs.size(), 0);
  for (const Chain& chain : layout.chains())
    if (plants[chain.plant]) active_[chain.pack] = 1;
  for (std::size_t p = 0; p < packs.size(); ++p)
    if (packs[p].active != (active_[p] != 0)) packs[p].active = active_[p] != 0;
}

const Clamp& RowStore::clamp_of(const Anchor& anchor) const {
  const std::vector<Clamp>& own = clamps[anchor.plant];
  const auto behind = std::ranges::upper_bound(own, anchor.first, {}, &Clamp::first_element);
  return *std::prev(behind);
}

void RowStore::place_anchors(int pack, std::span<PoseRow> poses) const {
  PoseRow& row = poses[packs[pack].begin];
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto& [plant, parent, first] = anchors[pack][lane];
    if (plant < 0) {
      put(row, lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
    } else if (parent < 0) {
      const Pose& clamp = clamp_of(anchors[pack][lane]).now;
      put(row, lane, clamp.position, clamp.rotation);
    } else {
      const Slot slot = layout.slot(plant, parent);
      const PoseRow& from = poses[slot.row];
      for (int i = 0; i < 3; ++i) row.position[i][lane] = from.position[i][slot.lane];
      for (int i = 0; i < 4; ++i) row.orientation[i][lane] = from.orientation[i][slot.lane];
    }
  }
}

// Clamps do not change; what else does is passed on.
void RowStore::take_anchors(int pack) {
  place_anchors(pack, scratch->iterate);
  for (Lanes& change : scratch->factor[packs[pack].begin].right)
    std::fill(std::begin(change), std::end(change), 0.0);
  packs[pack].anchored = true;
}

void RowStore::pass_on_changes(int task) {
  for (const auto& [from, to] : carriers[task])
    for (int i = 0; i < 6; ++i)
      scratch->factor[to.row].right[i][to.lane] = scratch->factor[from.row].right[i][from.lane];
}

void RowStore::pass_on_poses(int task) {
  for (const auto& [from, to] : carriers[task]) {
    const PoseRow& own = scratch->iterate[from.row];
    PoseRow& anchor = scratch->iterate[to.row];
    for (int i = 0; i < 3; ++i) anchor.position[i][to.lane] = own.position[i][from.lane];
    for (int i = 0; i < 4; ++i) anchor.orientation[i][to.lane] = own.orientation[i][from.lane];
  }
}

void RowStore::make_viscous(int pack) {
  packs[pack].viscous = true;
  if (!previous_strain.empty()) return;
  const auto rows = static_cast<std::size_t>(layout.rows());
  previous_strain.resize(rows, StrainRow{});
  if (scratch->strain.size() < rows) {
    scratch->strain.resize(rows);
    scratch->viscous.resize(rows);
  }
}

// Rows only grow: a plant that loses its laws keeps rows that add exact zeros.
bool RowStore::make_extensions(int law_branches) {
  extension.resize(layout.rows(), plain_row());
  extension_term.resize(layout.rows(), ExtensionTermRow{});
  if (law_branches <= law_branches_a_row) return false;
  law_branches_a_row = law_branches;
  law_branch.assign(static_cast<std::size_t>(layout.rows()) * law_branches_a_row, no_branch());
  return true;
}

void RowStore::add_to(FetchAhead& wanted) const {
  wanted.add(element);
  wanted.add(previous);
  wanted.add(previous_rate);
  wanted.add(previous_strain);
  wanted.add(extension);
  wanted.add(law_branch);
  wanted.add(packs);
}

void RowStore::fetch_along(FetchAhead* wanted) {
  constexpr int passes = 4;  // over the rows: states are read, elimination, solution, move
  ahead = wanted;
  if (wanted) wanted->share_out(passes * (layout.rows() - layout.packs()));
}

}  // namespace pedicel::cosserat
