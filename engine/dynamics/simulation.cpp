#include "engine/dynamics/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "engine/dynamics/fetch.h"
#include "engine/dynamics/state_hash.h"
#include "engine/error.h"
#include "engine/physics/collision.h"
#include "engine/physics/random.h"
#include "engine/physics/walls.h"

namespace clatter {

// The base moves after this many physical events per disk: rarely enough to cost little (each move
// plans every disk anew), often enough that times stay below some ten mean free times.
static constexpr std::uint64_t kEventsPerBase = 32;
static constexpr std::uint64_t kLeastEventsPerBase = 64;
// Fetching ahead pays once the disks no longer fit the cache.
static constexpr std::size_t kFetchAheadFrom = 20000;
// Overlap that a start state may have from the rounding of its positions, in diameters.
static constexpr double kStartRounding = 1e-12;

// The whole box lengths by which a position lies outside the box, along periodic axes.
template <int D>
static Vec<D> boxes_off(const Model<D>& model, const Vec<D>& position) {
  Vec<D> boxes = Vec<D>::Zero();
  for (int axis = 0; axis < D; ++axis) {
    const bool inside = position[axis] >= 0.0 && position[axis] < model.box[axis];
    if (inside || !model.periodic(axis)) continue;
    boxes[axis] = std::floor(position[axis] / model.box[axis]);
  }
  return boxes;
}

template <int D>
Simulation<D>::Simulation(const Model<D>& model, const State<D>& state, double start_time)
    : model_(model),
      clock_(start_time),
      disks_(state.positions.size()),
      plans_(disks_.size()),
      grid_(model_, disks_.size()),
      prediction_(model_, disks_, grid_),
      until_base_moves_(std::max<std::uint64_t>(kLeastEventsPerBase, disks_.size())) {
  for (std::size_t i = 0; i < disks_.size(); ++i) {
    disks_[i].flight = {state.positions[i], state.velocities[i], 0.0, 0};
    plans_[i].cell = grid_.cell_at(state.positions[i]);
    grid_.insert(static_cast<std::uint32_t>(i), plans_[i].cell);
  }
  if (const double overlap = deepest_overlap(); overlap > kStartRounding) {
    throw PhysicalStop("disks overlap at the start, the deepest by " + std::to_string(overlap) +
                       " diameters; move them apart");
  }
  plan_all();
}

template <int D>
void Simulation<D>::plan_all() {
  std::vector<Event> events;
  events.reserve(disks_.size());
  for (std::uint32_t i = 0; i < disks_.size(); ++i) {
    prediction_.plan(i, now_, plans_[i]);
    const Event event = plans_[i].event(i);
    if (event.time < kNever) events.push_back(event);
  }
  queue_.rebuild(events);
}

// Planning anew, rather than shifting what was planned, keeps every contact time a function of the
// two stored states alone.
template <int D>
void Simulation<D>::move_base() {
  const double shift = now_;
  for (Disk<D>& disk : disks_) disk.flight.time -= shift;
  clock_.advance(shift);
  now_ = 0.0;
  until_base_moves_ = std::max<std::uint64_t>(kLeastEventsPerBase, kEventsPerBase * disks_.size());
  plan_all();
  for (Observer<D>* observer : observers_) observer->on_base_moved(shift);
}

template <int D>
void Simulation<D>::schedule(std::uint32_t disk) {
  const Event event = plans_[disk].event(disk);
  if (event.time < kNever) queue_.push(event);
}

template <int D>
typename Simulation<D>::Halt Simulation<D>::advance(double stop, std::uint64_t collisions) {
  const auto live = [this](const Event& event) {
    const Event planned = plans_[event.disk].event(event.disk);
    return planned.time == event.time && planned.partner == event.partner;
  };
  const bool fetch = disks_.size() >= kFetchAheadFrom;
  while (counts_.collisions() < collisions) {
    const Event* next = queue_.top(live);
    if (!next || next->time > stop) return Halt::Time;
    const Event event = *next;
    queue_.pop();
    if (fetch && queue_.bucket() != fetched_bucket_) fetch_ahead();
    process(event);
    if (until_base_moves_ == 0) {
      move_base();
      return Halt::BaseMoved;
    }
  }
  return Halt::Collisions;
}

template <int D>
bool Simulation<D>::run_until(double time, std::uint64_t collisions) {
  for (;;) {
    const double end = clock_.relative(time);
    Timer* timer = due_timer(end);
    const double stop = timer ? clock_.relative(timer->start, timer->count, timer->interval) : end;
    const Halt halt = advance(stop, collisions);
    if (halt == Halt::BaseMoved) continue;
    if (halt == Halt::Collisions) return false;
    if (stop == kNever) return true;
    now_ = std::max(now_, stop);
    if (!timer) return true;
    fire(*timer);
  }
}

template <int D>
void Simulation<D>::every(double start, double interval, std::function<void(double)> action) {
  timers_.push_back({start, interval, 0, std::move(action)});
}

template <int D>
typename Simulation<D>::Timer* Simulation<D>::due_timer(double stop) {
  Timer* due = nullptr;
  for (Timer& timer : timers_) {
    if (timer.interval == 0.0 && timer.count > 0) continue;
    const double time = clock_.relative(timer.start, timer.count, timer.interval);
    if (time > stop || (due && time == stop)) continue;
    stop = time;
    due = &timer;
  }
  return due;
}

template <int D>
void Simulation<D>::fire(Timer& timer) {
  const double time = timer.start + static_cast<double>(timer.count) * timer.interval;
  ++timer.count;
  timer.action(time);
}

template <int D>
void Simulation<D>::process(const Event& event) {
  checks_.clock_steps_back = std::max(checks_.clock_steps_back, now_ - event.time);
  now_ = event.time;
  if (event.partner == kCellBorder) {
    enter_next_cell(event.disk);
  } else if (event.partner >= kWall) {
    hit_wall(event.disk, static_cast<int>(event.partner - kWall));
  } else if (plans_[event.disk].partner_flight != disks_[event.partner].flight.number) {
    ++counts_.stale;
    prediction_.plan(event.disk, now_, plans_[event.disk]);
    schedule(event.disk);
  } else {
    collide(event.disk, event.partner);
  }
}

template <int D>
void Simulation<D>::enter_next_cell(std::uint32_t number) {
  Plan<D>& plan = plans_[number];
  const int axis = plan.crossing_axis;
  const int step = plan.crossing_step;
  grid_.remove(number, plan.cell);
  plan.cell[axis] += step;
  if (plan.cell[axis] < 0 || plan.cell[axis] == grid_.counts()[axis]) {
    plan.cell[axis] -= step * grid_.counts()[axis];
    disks_[number].image[axis] += step;
  }
  grid_.insert(number, plan.cell);
  ++counts_.cell_crossings;
  prediction_.plan_entered(number, now_, axis, step, plan);
  schedule(number);
}

template <int D>
void Simulation<D>::renew_flight(Disk<D>& disk, const Vec<D>& position, const Vec<D>& velocity) {
  const Vec<D> boxes = boxes_off<D>(model_, position);
  disk.flight = {position - boxes.cwiseProduct(model_.box), velocity, now_, disk.flight.number + 1};
  disk.image -= boxes;
}

template <int D>
void Simulation<D>::collide(std::uint32_t first, std::uint32_t second) {
  Disk<D>& a = disks_[first];
  Disk<D>& b = disks_[second];
  const Vec<D> shift = plans_[first].image.template cast<double>().cwiseProduct(model_.box);
  const Vec<D> r_a = a.flight.at(now_);
  const Vec<D> r_b = b.flight.at(now_);
  const Vec<D> x = (r_a - r_b) + shift;
  const Vec<D> g = a.flight.v - b.flight.v;
  checks_.deepest_overlap = std::max(checks_.deepest_overlap, 1.0 - x.norm() / model_.diameter);
  // Disks that graze may recede at contact by rounding: then nothing passes between them, but the
  // event counts, so that it is not predicted again from the same states.
  Vec<D> impulse = Vec<D>::Zero();
  if (x.dot(g) < 0.0) impulse = collision_impulse<D>(x, g, model_.restitution);
  const Vec<D> v_a = a.flight.v + impulse;
  const Vec<D> v_b = b.flight.v - impulse;
  if (!observers_.empty()) {
    report_collision({first, second}, {r_a, r_b}, x, impulse, {v_a, v_b});
  }
  renew_flight(a, r_a, v_a);
  renew_flight(b, r_b, v_b);
  ++counts_.disk_disk;
  --until_base_moves_;
  prediction_.plan(first, now_, plans_[first]);
  schedule(first);
  prediction_.plan(second, now_, plans_[second]);
  schedule(second);
}

// What a change of velocity from v to w adds to the kinetic energy, without the rounding of the
// difference of two squares.
template <int D>
static double energy_gain(const Vec<D>& v, const Vec<D>& w) {
  return 0.5 * (w - v).dot(w + v);
}

template <int D>
void Simulation<D>::report_collision(std::array<std::uint32_t, 2> disks,
                                     std::array<Vec<D>, 2> position, const Vec<D>& separation,
                                     const Vec<D>& impulse, std::array<Vec<D>, 2> velocity) const {
  const int low = disks[0] < disks[1] ? 0 : 1;
  PairCollision<D> collision;
  collision.time = now_;
  collision.separation = low == 0 ? separation : Vec<D>(-separation);
  collision.impulse = low == 0 ? impulse : Vec<D>(-impulse);
  for (const int k : {0, 1}) {
    const int from = k ^ low;
    collision.disks[k] = disks[from];
    collision.before[k] = disks_[disks[from]].flight;
    collision.position[k] = position[from];
    collision.energy[k] = energy_gain<D>(collision.before[k].v, velocity[from]);
  }
  for (Observer<D>* observer : observers_) observer->on_collision(collision);
}

template <int D>
Vec<D> Simulation<D>::velocity_after_wall(std::uint32_t number, int side) const {
  const Disk<D>& disk = disks_[number];
  const Wall& wall = *model_.walls[side];
  const int axis = side / 2;
  const double inward = side % 2 ? -1.0 : 1.0;
  if (wall.kind != WallKind::Thermal) {
    return reflect<D>(disk.flight.v, axis, inward, wall.restitution, wall.drive_speed);
  }
  Random random(model_.seed, Stream::ThermalWall, number, disk.flight.number);
  const double uniform = random.uniform();
  std::array<double, D - 1> normals;
  for (double& normal : normals) normal = random.normal();
  return emit<D>(axis, inward, wall.temperature, uniform, normals.data());
}

template <int D>
void Simulation<D>::hit_wall(std::uint32_t number, int side) {
  Disk<D>& disk = disks_[number];
  const Vec<D> r = disk.flight.at(now_);
  const Vec<D> v = velocity_after_wall(number, side);
  if (!observers_.empty()) {
    const WallCollision<D> collision{
        now_, number, side, disk.flight, r, v - disk.flight.v, energy_gain<D>(disk.flight.v, v)};
    for (Observer<D>* observer : observers_) observer->on_wall(collision);
  }
  renew_flight(disk, r, v);
  ++counts_.disk_wall;
  --until_base_moves_;
  prediction_.plan(number, now_, plans_[number]);
  schedule(number);
}

template <int D>
State<D> Simulation<D>::state() const {
  State<D> state;
  state.positions.reserve(disks_.size());
  state.velocities.reserve(disks_.size());
  for (const Disk<D>& disk : disks_) {
    Vec<D> r = disk.flight.at(now_);
    r -= boxes_off<D>(model_, r).cwiseProduct(model_.box);
    for (int axis = 0; axis < D; ++axis) {
      // What lies a rounding error below 0 comes out at the far end, which is 0 again.
      if (model_.periodic(axis) && r[axis] == model_.box[axis]) r[axis] = 0.0;
    }
    state.positions.push_back(r);
    state.velocities.push_back(disk.flight.v);
  }
  return state;
}

template <int D>
std::uint64_t Simulation<D>::state_hash() const {
  return clatter::state_hash<D>(state());
}

template <int D>
double Simulation<D>::kinetic_energy() const {
  double twice = 0.0;
  for (const Disk<D>& disk : disks_) twice += disk.flight.v.squaredNorm();
  return 0.5 * twice;
}

template <int D>
double Simulation<D>::deepest_overlap() const {
  double deepest = 0.0;
  for (std::uint32_t i = 0; i < disks_.size(); ++i) {
    const Vec<D> r = disks_[i].flight.at(now_);
    grid_.visit(plans_[i].cell, {}, [&](const auto& line, const Vec<D>* wrap) {
      for (std::uint32_t k = 0; k < line.count; ++k) {
        const std::uint32_t j = line.disks[k];
        if (j <= i) continue;
        Vec<D> image = disks_[j].image - disks_[i].image;
        if (wrap) image -= *wrap;
        const Vec<D> x = r - disks_[j].flight.at(now_) + image.cwiseProduct(model_.box);
        deepest = std::max(deepest, 1.0 - x.norm() / model_.diameter);
      }
    });
    for (int axis = 0; axis < D; ++axis) {
      if (model_.periodic(axis)) continue;
      const double beyond =
          std::max(model_.wall_plane(axis, 0) - r[axis], r[axis] - model_.wall_plane(axis, 1));
      deepest = std::max(deepest, beyond / model_.diameter);
    }
  }
  return deepest;
}

// Three looks ahead, each of which finds in the cache what the one before fetched: the disk and its
// plan, then its partner and the cells about it, then the disks in those cells.
template <int D>
void Simulation<D>::fetch_ahead() {
  fetched_bucket_ = queue_.bucket();
  queue_.look_ahead(8, [&](const Event& event) {
    fetch(disks_[event.disk]);
    fetch(plans_[event.disk]);
  });
  queue_.look_ahead(5, [&](const Event& event) {
    if (event.partner < kWall) {
      fetch(disks_[event.partner]);
      fetch(plans_[event.partner]);
    }
    grid_.visit_first_lines(plans_[event.disk].cell, {}, [](const auto& line) { fetch(line); });
  });
  queue_.look_ahead(3, [&](const Event& event) {
    grid_.visit_first_lines(plans_[event.disk].cell, {}, [&](const auto& line) {
      for (std::uint32_t k = 0; k < line.count; ++k) fetch(disks_[line.disks[k]]);
    });
  });
}

template class Simulation<2>;

}  // namespace clatter
