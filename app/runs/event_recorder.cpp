#include "app/runs/event_recorder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "engine/checkpoint/archive.h"
#include "engine/error.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

// The part of a recorder that a checkpoint keeps.
struct SavedEvents {
  std::vector<std::uint32_t> particles;
  std::vector<double> region;
  double share = 1.0;
  bool spins = false;
  std::uint8_t format = 0;  // EventLogFormat
  std::uint64_t candidates = 0;
  std::uint64_t bytes = 0;
};

template <class Archive>
void visit(Archive& io, SavedEvents& saved) {
  auto& [particles, region, share, spins, format, candidates, bytes] = saved;
  io(particles, region, share, spins, format, candidates, bytes);
}

std::string bytes_of(const std::vector<double>& numbers) {
  std::string bytes(numbers.size() * sizeof(double), '\0');
  if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

}  // namespace

std::filesystem::path records_path(const std::filesystem::path& log) {
  if (event_log_format(log, "--events") == EventLogFormat::Csv) return log;
  return log.string() + ".records";
}

std::filesystem::path particles_path(const std::filesystem::path& log) {
  std::filesystem::path path = log;
  return path.replace_extension(".particles.csv");
}

template <int D>
EventRecorder<D>::EventRecorder(const std::filesystem::path& path, EventSelection selection,
                                bool spins, std::vector<std::string> species,
                                Simulation<D>& simulation)
    : format_(event_log_format(path, "--events")),
      path_(path),
      selection_(std::move(selection)),
      spins_(spins),
      species_(std::move(species)),
      quantities_(event_quantities(D, spins)),
      simulation_(simulation),
      observation_(simulation, *this) {
  file_.emplace(records_path(path_), 0);
  if (format_ == EventLogFormat::Csv) file_->append(csv_header(quantities_));
}

template <int D>
EventRecorder<D>::EventRecorder(const std::filesystem::path& path, EventSelection selection,
                                bool spins, std::vector<std::string> species,
                                Simulation<D>& simulation, const std::string& saved,
                                const std::string& checkpoint)
    : format_(event_log_format(path, "--events")),
      path_(path),
      selection_(std::move(selection)),
      spins_(spins),
      species_(std::move(species)),
      quantities_(event_quantities(D, spins)),
      simulation_(simulation),
      observation_(simulation, *this) {
  ArchiveReader reader(saved, checkpoint);
  SavedEvents before;
  reader(before);
  reader.finish();
  if (before.particles != selection_.particles || before.region != selection_.region ||
      before.share != selection_.share) {
    throw UserError({"--events", 0, 0}, "the event log of the checkpoint has other events",
                    "give the flags --events-... of the interrupted run");
  }
  if (before.format != static_cast<std::uint8_t>(format_)) {
    throw UserError({"--events", 0, 0},
                    path.string() + " has another format than the event log of the checkpoint",
                    "name the event log of the interrupted run");
  }
  if (before.spins != spins_) {
    throw UserError({"--events", 0, 0}, "the events of the checkpoint have other columns",
                    "resume the run without changes of roughness, or without --events");
  }
  candidates_ = before.candidates;
  file_.emplace(records_path(path_), before.bytes);
}

// Events at equal distances in the sequence are a share of them.
template <int D>
bool EventRecorder<D>::selects(const ParticleChange<D>& first, const ParticleChange<D>* second) {
  const auto listed = [&](const ParticleChange<D>& change) {
    return std::ranges::find(selection_.particles, change.particle) != selection_.particles.end();
  };
  const auto inside = [&](const ParticleChange<D>& change) {
    const Vec<D> place = simulation_.domain().wrapped(change.position);
    for (int axis = 0; axis < D; ++axis) {
      const auto low = static_cast<std::size_t>(2 * axis);
      if (place[axis] < selection_.region[low] || place[axis] > selection_.region[low + 1]) {
        return false;
      }
    }
    return true;
  };
  if (!selection_.particles.empty() && !listed(first) && !(second && listed(*second))) return false;
  if (!selection_.region.empty() && !inside(first) && !(second && inside(*second))) return false;
  const auto number = static_cast<double>(candidates_++);
  return std::floor((number + 1.0) * selection_.share) > std::floor(number * selection_.share);
}

template <int D>
void EventRecorder<D>::on_collision(const PairCollision<D>& collision) {
  const auto& [first, second] = collision.particles;
  if (!selects(first, &second)) return;
  append_record<D>(records_, simulation_.domain(), simulation_.time(), collision, spins_);
}

template <int D>
void EventRecorder<D>::on_wall(const WallCollision<D>& collision) {
  if (!selects(collision.particle, nullptr)) return;
  append_record<D>(records_, simulation_.domain(), simulation_.time(), collision, spins_);
}

template <int D>
void EventRecorder<D>::flush() {
  if (records_.empty()) return;
  file_->append(format_ == EventLogFormat::Csv ? csv_lines(records_, record_size(quantities_))
                                               : bytes_of(records_));
  records_.clear();
}

template <int D>
std::string EventRecorder<D>::save() {
  flush();
  file_->sync();
  SavedEvents saved{selection_.particles,
                    selection_.region,
                    selection_.share,
                    spins_,
                    static_cast<std::uint8_t>(format_),
                    candidates_,
                    file_->bytes()};
  ArchiveWriter writer;
  writer(saved);
  return writer.written();
}

// The particles at the end, with those that entered during the run.
template <int D>
LoggedParticles EventRecorder<D>::logged_particles() const {
  LoggedParticles particles{.species = species_, .grains = {}};
  for (std::uint32_t i = 0; !species_.empty() && i < simulation_.particles().size(); ++i) {
    particles.grains.push_back(simulation_.grain(i));
  }
  return particles;
}

template <int D>
void EventRecorder<D>::finish(bool resumable) {
  flush();
  file_->sync();
  const LoggedParticles particles = logged_particles();
  if (format_ == EventLogFormat::Hdf5) {
    write_event_file(path_, records_path(path_), quantities_, particles);
  } else if (!particles.species.empty()) {
    write_file(particles_path(path_), csv_text(particles));
  }
  file_->close();
  if (format_ == EventLogFormat::Csv || resumable) return;
  std::error_code ignored;
  std::filesystem::remove(records_path(path_), ignored);
}

template <int D>
std::string EventRecorder<D>::flags() const {
  std::string flags = "--events " + path_.string();
  if (!selection_.particles.empty()) {
    flags += fmt::format(" --events-of {}", fmt::join(selection_.particles, ","));
  }
  if (!selection_.region.empty()) {
    flags += fmt::format(" --events-in {}", fmt::join(selection_.region, ","));
  }
  if (selection_.share < 1.0) flags += fmt::format(" --events-share {}", selection_.share);
  return flags;
}

template class EventRecorder<2>;
template class EventRecorder<3>;

}  // namespace clatter
