#include "pedicel/cosserat/solver/rod_rows.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "pedicel/cosserat/lanes/lane_access.h"
#include "pedicel/cosserat/lanes/lane_kernels.h"

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

constexpr int smallest_share = 400;  // elements: less is not worth waking a thread for

TaskGraph graph_of(const LaneLayout& layout, std::span<const RodModel* const> plants, int threads) {
  std::vector<double> rows(layout.tasks(), 1.0);
  for (int p = 0; p < layout.packs(); ++p) rows[p] = layout.end_row(p) - layout.first_row(p);
  int elements = 0;
  for (const RodModel* const plant : plants) elements += plant->size();
  return {layout.needs(), rows, std::clamp(elements / smallest_share, 1, threads)};
}

constexpr int at(int i, int j) {  // in a lower triangle by rows
  return i >= j ? i * (i + 1) / 2 + j : j * (j + 1) / 2 + i;
}

}  // namespace

RowScratch::RowScratch(bool on_huge_pages)
    : pages_(on_huge_pages ? std::make_unique<HugePages>() : nullptr),
      memory(pages_ ? pages_.get() : std::pmr::get_default_resource()) {}

RodRows::RodRows(std::span<const RodModel* const> plants, int threads, bool keep_blocks,
                 std::shared_ptr<RowScratch> scratch)
    : scratch_(scratch ? std::move(scratch) : std::make_shared<RowScratch>()),
      layout_(plants, keep_blocks),
      graph_(graph_of(layout_, plants, threads)),
      packs_(layout_.packs()),
      element_(layout_.rows(), empty_row(), scratch_->memory),
      previous_(layout_.rows(), identity_row(), scratch_->memory),
      previous_rate_(layout_.rows(), RateRow{}, scratch_->memory),
      previous_strain_(scratch_->memory),
      extended_(plants.size()),
      first_branch_(layout_.rows(), -1),
      first_extra_(layout_.rows(), -1),
      anchors_(layout_.packs()),
      carriers_(layout_.tasks()),
      roots_(plants.size()),
      schemes_(plants.size()),
      shares_(plants.size(), 0.0) {
  std::vector<int> order;
  for (int thread = 0; thread < graph_.threads(); ++thread)
    std::ranges::copy_if(graph_.tasks_of(thread), std::back_inserter(order),
                         [&](int task) { return layout_.is_pack(task); });
  layout_.place(order);
  const auto grow = [&](auto& rows) {
    if (static_cast<int>(rows.size()) < layout_.rows()) rows.resize(layout_.rows());
  };
  grow(scratch_->start);
  grow(scratch_->iterate);
  grow(scratch_->rate);
  grow(scratch_->term);
  grow(scratch_->factor);
  if (std::any_of(plants.begin(), plants.end(),
                  [](const RodModel* m) { return !m->welds.empty(); }) ||
      keep_blocks)
    grow(scratch_->blocks);
  for (int p = 0; p < layout_.packs(); ++p) {
    packs_[p] = Pack{};
    packs_[p].begin = layout_.first_row(p);
    packs_[p].end = layout_.end_row(p);
    std::fill(std::begin(packs_[p].effective_step), std::end(packs_[p].effective_step), 1.0);
    std::fill(std::begin(packs_[p].past_now), std::end(packs_[p].past_now), 1.0);
    std::fill(std::begin(packs_[p].modulus), std::end(packs_[p].modulus), 1.0);
  }
  // From the last chain to the first, so that the sources of a row are taken in their order.
  for (int c = static_cast<int>(layout_.chains().size()) - 1; c >= 0; --c) {
    const Chain& chain = layout_.chains()[c];
    anchors_[chain.pack][chain.lane] = {chain.plant, chain.from};
    if (chain.from < 0) continue;
    const Slot slot = layout_.slot(chain.plant, chain.from);
    carriers_[layout_.task_of(layout_.chains()[chain.parent].pack, slot.row)].push_back(
        {slot, {packs_[chain.pack].begin, chain.lane}});
    if (layout_.keeps_blocks(chain.pack)) continue;
    branches_.push_back({packs_[chain.pack].branch[0] + chain.lane, lane_count, slot.lane,
                         first_branch_[slot.row]});
    first_branch_[slot.row] = static_cast<int>(branches_.size()) - 1;
  }
  for (std::vector<Carrier>& carriers : carriers_)
    std::ranges::sort(carriers, std::ranges::less{},
                      [](const Carrier& c) { return c.element.row; });
  for (int p = 0; p < static_cast<int>(plants.size()); ++p) read_model(p, *plants[p]);
}

RowArrays RodRows::arrays() {
  RowArrays rows;
  rows.element = element_.data();
  rows.start = scratch_->start.data();
  rows.iterate = scratch_->iterate.data();
  rows.previous = previous_.data();
  rows.rate = scratch_->rate.data();
  rows.previous_rate = previous_rate_.data();
  rows.strain = scratch_->strain.data();
  rows.previous_strain = previous_strain_.data();
  rows.viscous = scratch_->viscous.data();
  rows.term = scratch_->term.data();
  rows.factor = scratch_->factor.data();
  rows.blocks = scratch_->blocks.data();
  rows.first_branch = first_branch_.data();
  rows.first_extra = first_extra_.data();
  rows.branches = branches_.data();
  rows.extras = extras_.data();
  rows.extension = extension_.data();
  rows.extension_term = extension_term_.data();
  rows.law_branch = branch_.data();
  rows.joint_term = joint_term_.data();
  rows.law_branches = branches_a_row_;
  rows.axis_share = axis_share_;
  for (int i = 0; i < 3; ++i) rows.gravity[i] = gravity_[i];
  rows.ahead = ahead_;
  return rows;
}

// Variable-step BDF2 (Hairer, Norsett & Wanner, Solving ODEs I, section III.5).
void RodRows::set_scheme(int plant, double dt, double previous_dt, const Pose& root,
                         bool accelerate) {
  roots_[plant] = root;
  const Scheme scheme{dt, previous_dt, accelerate};
  if (scheme == schemes_[plant]) return;  // mostly; see set_active()
  schemes_[plant] = scheme;
  const bool first_order = previous_dt == 0.0;
  const double ratio = first_order ? 0.0 : dt / previous_dt;
  const double divisor = 1.0 + 2.0 * ratio;
  for (const auto [p, begin, end] : layout_.lanes_of_plant(plant)) {
    Pack& pack = packs_[p];
    for (int lane = begin; lane < end; ++lane) {
      pack.past_now[lane] = (1.0 + ratio) * (1.0 + ratio) / divisor;
      pack.past_before[lane] = ratio * ratio / divisor;
      pack.effective_step[lane] = dt * ((1.0 + ratio) / divisor);
      pack.accelerate[lane] = accelerate ? dt : 0.0;
    }
  }
}

void RodRows::set_gravity(const Vec3& gravity) {
  gravity_ = gravity;
}

void RodRows::add_to(FetchAhead& ahead) const {
  ahead.add(element_);
  ahead.add(previous_);
  ahead.add(previous_rate_);
  ahead.add(previous_strain_);
  ahead.add(extension_);
  ahead.add(branch_);
  ahead.add(packs_);
}

void RodRows::fetch_along(FetchAhead* ahead) {
  constexpr int passes = 4;  // over the rows: states are read, elimination, solution, move
  ahead_ = ahead;
  if (ahead) ahead->share_out(passes * (layout_.rows() - layout_.packs()));
}

// Packs that stay as they are are not written to: a thread has them in its core's cache.
void RodRows::set_active(std::span<const char> plants) {
  if (std::ranges::equal(plants, active_plants_)) return;
  active_plants_.assign(plants.begin(), plants.end());
  active_.assign(packs_.size(), 0);
  for (const Chain& chain : layout_.chains())
    if (plants[chain.plant]) active_[chain.pack] = 1;
  for (std::size_t p = 0; p < packs_.size(); ++p)
    if (packs_[p].active != (active_[p] != 0)) packs_[p].active = active_[p] != 0;
}

template <class Do>
void RodRows::each_pack(ThreadPool& pool, const Do& todo) {
  graph_.each(pool, [&](int task) {
    if (layout_.is_pack(task)) todo(task);
  });
}

// Those of all its plants. What remembers more than poses and velocities is read.
bool RodRows::has_states(int pack, std::span<const char> unchanged) const {
  return keeps_end_ && std::ranges::all_of(anchors_[pack], [&](const Anchor& anchor) {
           const int plant = anchor.plant;
           return plant < 0 || (unchanged[plant] && extended_[plant].branches == 0);
         });
}

void RodRows::prepare(ThreadPool& pool, std::span<const RodState* const> states,
                      std::span<const char> unchanged) {
  keeps_end_ = keeps_end_ && !unchanged.empty();
  const RowArrays rows = arrays();
  each_pack(pool, [&](int p) {
    packs_[p].anchored = false;
    if (!packs_[p].active) return;
    if (!has_states(p, unchanged)) read_states(p, states);
    cosserat::prepare(rows, packs_[p]);
  });
}

// The parents' poses into a pack's first row: theirs must have been moved already.
void RodRows::place_anchors(int pack, std::span<PoseRow> poses) const {
  PoseRow& row = poses[packs_[pack].begin];
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto [plant, parent] = anchors_[pack][lane];
    if (plant < 0) {
      put(row, lane, Vec3(0, 0, 0), Quat(1, 0, 0, 0));
    } else if (parent < 0) {
      put(row, lane, roots_[plant].position, roots_[plant].rotation);
    } else {
      const Slot slot = layout_.slot(plant, parent);
      const PoseRow& from = poses[slot.row];
      for (int i = 0; i < 3; ++i) row.position[i][lane] = from.position[i][slot.lane];
      for (int i = 0; i < 4; ++i) row.orientation[i][lane] = from.orientation[i][slot.lane];
    }
  }
}

// The iterate's, where prepare() has just made it, which does not wait for parents. Clamps do not
// change; what else does is passed on.
void RodRows::take_anchors(int pack) {
  place_anchors(pack, scratch_->iterate);
  for (Lanes& change : scratch_->factor[packs_[pack].begin].right)
    std::fill(std::begin(change), std::end(change), 0.0);
  packs_[pack].anchored = true;
}

// To the first rows of the packs that are carried: each of them would fetch eight times as much
// from all over this one, perhaps out of another core's cache.
void RodRows::pass_on_changes(int task) {
  for (const auto& [from, to] : carriers_[task])
    for (int i = 0; i < 6; ++i)
      scratch_->factor[to.row].right[i][to.lane] = scratch_->factor[from.row].right[i][from.lane];
}

void RodRows::pass_on_poses(int task) {
  for (const auto& [from, to] : carriers_[task]) {
    const PoseRow& own = scratch_->iterate[from.row];
    PoseRow& anchor = scratch_->iterate[to.row];
    for (int i = 0; i < 3; ++i) anchor.position[i][to.lane] = own.position[i][from.lane];
    for (int i = 0; i < 4; ++i) anchor.orientation[i][to.lane] = own.orientation[i][from.lane];
  }
}

void RodRows::write_iterate(ThreadPool& pool, std::span<RodState* const> states) {
  each_pack(pool, [&](int p) { write_pack(p, states); });
}

// Nothing needs the clamps of the start any more: prepare() has taken the strains against them.
void RodRows::compare_start(ThreadPool& pool, std::span<RodState* const> states) {
  const RowArrays at_guess = arrays();
  RowArrays at_start = at_guess;
  at_start.iterate = at_start.start;
  each_pack(pool, [&](int p) {
    if (!packs_[p].active) return;
    place_anchors(p, scratch_->start);
    take_anchors(p);
    evaluate(at_start, packs_[p], packs_[p].energy_before);
    evaluate(at_guess, packs_[p], packs_[p].energy);
    write_pack(p, states);
  });
}

void RodRows::hold(int plant) {
  for (const int c : layout_.chains_of_plant(plant)) {
    const Chain& chain = layout_.chains()[c];
    const auto copy = [&](int row) {
      put(scratch_->iterate[row], chain.lane, vector_at(scratch_->start[row].position, chain.lane),
          rotation_at(scratch_->start[row].orientation, chain.lane));
    };
    for (const int e : chain.elements) copy(layout_.slot(plant, e).row);
  }
  for (const LaneRun& run : layout_.lanes_of_plant(plant))
    place_anchors(run.pack, scratch_->iterate);
}

void RodRows::clear_extras() {
  for (const int row : extra_rows_) first_extra_[row] = -1;
  extra_rows_.clear();
  extras_.clear();
}

void RodRows::add_extras(int plant, const ElementBlocks& blocks) {
  for (std::size_t i = 0; i < blocks.elements.size(); ++i) {
    if (blocks.elements[i] < 0) continue;
    const Slot slot = layout_.slot(plant, blocks.elements[i]);
    extras_.push_back({blocks.values[i].values.data(), 1, slot.lane, first_extra_[slot.row]});
    first_extra_[slot.row] = static_cast<int>(extras_.size()) - 1;
    extra_rows_.push_back(slot.row);
  }
}

void RodRows::eliminate_task(const RowArrays& rows, int task) {
  const int pack = layout_.pack_of(task);
  if (!packs_[pack].active) return;
  for (const int branch : graph_.needs(task))  // perhaps in another core's cache
    for (const Lanes& values : packs_[branch].branch) __builtin_prefetch(values);
  if (!layout_.is_pack(task)) {
    solve_last(rows, packs_[pack]);
    return;
  }
  if (!packs_[pack].anchored) take_anchors(pack);
  if (layout_.keeps_blocks(pack))
    linearise(rows, packs_[pack]);
  else if (layout_.from_clamp(pack))
    eliminate_from_clamp(rows, packs_[pack]);
  else
    linearise_and_eliminate(rows, packs_[pack]);
}

void RodRows::eliminate(ThreadPool& pool) {
  const RowArrays rows = arrays();
  graph_.inward(pool, [&](int task) { eliminate_task(rows, task); });
}

void RodRows::copy_blocks(int plant, BlockSystem& system) const {
  system.clear();
  for (const int c : layout_.chains_of_plant(plant)) {
    const Chain& chain = layout_.chains()[c];
    const int lane = chain.lane;
    int parent = anchors_[chain.pack][lane].element;
    for (const int e : chain.elements) {
      const int row = layout_.slot(plant, e).row;
      const BlocksRow& from = scratch_->blocks[row];
      if (element_[row].alive[lane] == 0.0) {
        system.diagonal(e).setIdentity();
        parent = e;
        continue;
      }
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) system.diagonal(e)(i, j) += from.diagonal[at(i, j)][lane];
        system.right_side(e)[i] += from.right[i][lane];
      }
      if (parent >= 0) {
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) {
            const double stretch = from.coupling[at(i, j)][lane];
            const double bend = from.coupling[15 + at(i, j)][lane];
            system.coupling(e)(i, j) = -stretch;
            system.coupling(e)(3 + i, j) = -from.coupling[6 + 3 * i + j][lane];
            system.coupling(e)(3 + i, 3 + j) = -bend;
            system.diagonal(parent)(i, j) += stretch;
            system.diagonal(parent)(3 + i, 3 + j) += bend;
          }
        }
        for (int i = 0; i < 6; ++i) system.right_side(parent)[i] += from.on_parent[i][lane];
      }
      parent = e;
    }
  }
}

void RodRows::set_change(int plant, const BlockSystem& solved) {
  for (const int c : layout_.chains_of_plant(plant)) {
    const Chain& chain = layout_.chains()[c];
    for (const int e : chain.elements) {
      const Slot slot = layout_.slot(plant, e);
      const double alive = element_[slot.row].alive[slot.lane];
      for (int i = 0; i < 6; ++i)
        scratch_->factor[slot.row].right[i][slot.lane] = alive * solved.solution(e)[i];
    }
    // Its lane goes on where a longer chain stands beside it: nothing moves there.
    const int behind = layout_.slot(plant, chain.elements.back()).row + 1;
    for (int row = behind; row < layout_.end_row(chain.pack); ++row)
      for (Lanes& change : scratch_->factor[row].right) change[chain.lane] = 0.0;
  }
}

void RodRows::substitute_task(const RowArrays& rows, int task) {
  const int pack = layout_.pack_of(task);
  if (!packs_[pack].active) return;
  if (layout_.keeps_blocks(pack)) {
    measure_change(rows, packs_[pack]);
    return;
  }
  if (layout_.is_pack(task)) {
    if (layout_.from_clamp(pack))
      substitute_to_clamp(rows, packs_[pack]);
    else
      cosserat::substitute(rows, packs_[pack]);
  }
  pass_on_changes(task);
}

void RodRows::substitute(ThreadPool& pool) {
  const RowArrays rows = arrays();
  graph_.outward(pool, [&](int task) { substitute_task(rows, task); });
}

void RodRows::solve_and_move(ThreadPool& pool, bool measured, std::span<RodState* const> states) {
  const RowArrays rows = arrays();
  graph_.inward_and_outward(
      pool, [&](int task) { eliminate_task(rows, task); },
      [&](int task) {
        substitute_task(rows, task);
        move_task(rows, task, true, measured, states);
      });
}

void RodRows::set_share(int plant, double share) {
  if (share == shares_[plant]) return;
  shares_[plant] = share;
  for (const auto [p, begin, end] : layout_.lanes_of_plant(plant))
    std::fill(packs_[p].share + begin, packs_[p].share + end, share);
}

void RodRows::move(ThreadPool& pool, bool keep, bool measured, std::span<RodState* const> states) {
  const RowArrays rows = arrays();
  graph_.outward(pool, [&](int task) { move_task(rows, task, keep, measured, states); });
}

void RodRows::move_task(const RowArrays& rows, int task, bool keep, bool measured,
                        std::span<RodState* const> states) {
  Pack& pack = packs_[layout_.pack_of(task)];
  if (!pack.active) return;
  const bool is_pack = layout_.is_pack(task), whole = !layout_.from_clamp(layout_.pack_of(task));
  const int last = pack.end - 1;  // a task of its own where the pack is not whole
  cosserat::move(rows, pack, is_pack ? pack.begin + 1 : last, is_pack && !whole ? last : pack.end,
                 keep, measured && whole);
  pass_on_poses(task);
  if (!is_pack) return;
  if (measured && !whole) evaluate(rows, pack, pack.energy);
  write_pack(task, states);
}

void RodRows::measure(ThreadPool& pool) {
  const RowArrays rows = arrays();
  each_pack(pool, [&](int p) {
    if (packs_[p].active) evaluate(rows, packs_[p], packs_[p].energy);
  });
}

void RodRows::finish(ThreadPool& pool, std::span<RodState* const> states) {
  const RowArrays rows = arrays();
  each_pack(pool, [&](int p) {
    cosserat::finish(rows, packs_[p], previous_rate_.data());
    write_end(p, states);
  });
}

void RodRows::end_step() {
  keeps_end_ = scratch_.use_count() == 1;  // what a step leaves there is nobody else's
  if (keeps_end_) {
    scratch_->start.swap(previous_);
    scratch_->start.swap(scratch_->iterate);
    scratch_->rate.swap(previous_rate_);
    scratch_->strain.swap(previous_strain_);
    return;
  }
  std::copy_n(scratch_->start.begin(), layout_.rows(), previous_.begin());
  std::copy_n(scratch_->rate.begin(), layout_.rows(), previous_rate_.begin());
  std::copy_n(scratch_->strain.begin(), previous_strain_.size(), previous_strain_.begin());
}

// From the caches of the cores that computed them.
void RodRows::fetch_results() const {
  for (const Pack& pack : packs_)
    for (const auto* result :
         {&pack.energy_before, &pack.energy, &pack.turn, &pack.shift, &pack.change, &pack.healthy})
      __builtin_prefetch(result);
}

double RodRows::sum(int plant, const Lanes Pack::*energy) const {
  double sum = 0.0;
  for (const auto [p, begin, end] : layout_.lanes_of_plant(plant))
    for (int lane = begin; lane < end; ++lane) sum += (packs_[p].*energy)[lane];
  return sum;
}

bool RodRows::healthy(int plant) const {
  return std::ranges::all_of(layout_.lanes_of_plant(plant), [&](const LaneRun& run) {
    const Lanes& healthy = packs_[run.pack].healthy;
    return layout_.keeps_blocks(run.pack) ||
           std::all_of(healthy + run.begin, healthy + run.end, [](double h) { return h > 0.0; });
  });
}

NewtonChange RodRows::change(int plant) const {
  NewtonChange change;
  for (const auto [p, begin, end] : layout_.lanes_of_plant(plant)) {
    const Pack& pack = packs_[p];
    for (int lane = begin; lane < end; ++lane) {
      change.turn = std::max(change.turn, pack.turn[lane]);
      change.shift = std::max(change.shift, pack.shift[lane]);
      change.largest = std::max(change.largest, pack.change[lane]);
    }
  }
  return change;
}

Vec6 RodRows::change(int plant, int element) const {
  const auto [row, lane] = layout_.slot(plant, element);
  Vec6 change;
  for (int i = 0; i < 6; ++i) change[i] = scratch_->factor[row].right[i][lane];
  return change;
}

int RodRows::largest_change(int plant, int elements) const {
  int worst = -1;
  double largest = 0.0;
  for (int e = 0; e < elements; ++e) {
    const double found = change(plant, e).cwiseAbs().maxCoeff();
    if (found <= largest) continue;
    largest = found;
    worst = e;
  }
  return worst;
}

}  // namespace pedicel::cosserat
