#include "app/results/event_log.h"

#include <H5Cpp.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

#include "app/results/hdf5_writer.h"
#include "engine/error.h"
#include "engine/scene/field.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// A zero has no sign: its sign depends on the halts of the run.
template <class Vector>
void add(std::vector<double>& records, const Vector& vector) {
  for (const double number : vector) records.push_back(number + 0.0);
}

template <int D>
void add_spins(std::vector<double>& records, const ParticleChange<D>& change) {
  add(records, change.spin);
  add(records, Spin<D>(change.spin + change.gain.spin));
}

}  // namespace

EventLogFormat event_log_format(const std::filesystem::path& file, const char* flag) {
  if (is_special(file)) {
    throw UserError({flag, 0, 0}, file.string() + " is not a regular file",
                    "give the name of a file, not of a device or a pipe");
  }
  if (file.extension() == ".csv") return EventLogFormat::Csv;
  if (file.extension() == ".h5") return EventLogFormat::Hdf5;
  throw UserError({flag, 0, 0}, file.string() + " has no extension of an event log",
                  "give a name that ends in .h5 or .csv");
}

std::vector<EventQuantity> event_quantities(int dimension, bool spins) {
  std::vector<std::string> axes, spin_axes = {""};
  for (int axis = 0; axis < dimension; ++axis) axes.push_back(std::string("_") + "xyz"[axis]);
  if (dimension == 3) spin_axes = axes;
  std::vector<EventQuantity> quantities = {{"time", "t", {""}},
                                           {"kind", "1", {""}, true},
                                           {"particle", "1", {""}, true},
                                           {"partner", "1", {""}, true},
                                           {"position", "a", axes},
                                           {"partner_position", "a", axes},
                                           {"velocity_before", "a/t", axes},
                                           {"velocity_after", "a/t", axes},
                                           {"partner_velocity_before", "a/t", axes},
                                           {"partner_velocity_after", "a/t", axes},
                                           {"impulse", "m a/t", axes}};
  if (!spins) return quantities;
  for (const char* name :
       {"spin_before", "spin_after", "partner_spin_before", "partner_spin_after"}) {
    quantities.push_back({name, "1/t", spin_axes});
  }
  return quantities;
}

std::size_t record_size(const std::vector<EventQuantity>& quantities) {
  std::size_t size = 0;
  for (const EventQuantity& quantity : quantities) size += quantity.components.size();
  return size;
}

template <int D>
void append_record(std::vector<double>& records, const Domain<D>& domain, double time,
                   const PairCollision<D>& collision, bool spins) {
  const auto& [first, second] = collision.particles;
  records.insert(records.end(), {time, 0.0, static_cast<double>(first.particle),
                                 static_cast<double>(second.particle)});
  add(records, domain.wrapped(first.position));
  add(records, domain.wrapped(second.position));
  add(records, first.velocity);
  add(records, first.velocity_after());
  add(records, second.velocity);
  add(records, second.velocity_after());
  add(records, first.gain.momentum);
  if (!spins) return;
  add_spins(records, first);
  add_spins(records, second);
}

template <int D>
void append_record(std::vector<double>& records, const Domain<D>& domain, double time,
                   const WallCollision<D>& collision, bool spins) {
  const ParticleChange<D>& change = collision.particle;
  // A box with a piston has no fixtures.
  const double fixture = collision.at_piston() ? 0.0 : collision.fixture;
  records.insert(records.end(), {time, collision.at_wall() ? 1.0 + collision.side : 7.0 + fixture,
                                 static_cast<double>(change.particle), -1.0});
  const Vec<D> none = Vec<D>::Constant(kNone);
  add(records, domain.wrapped(change.position));
  add(records, none);
  add(records, change.velocity);
  add(records, change.velocity_after());
  add(records, none);
  add(records, none);
  add(records, change.gain.momentum);
  if (!spins) return;
  add_spins(records, change);
  const Spin<D> no_spin = Spin<D>::Constant(kNone);
  add(records, no_spin);
  add(records, no_spin);
}

std::string csv_header(const std::vector<EventQuantity>& quantities) {
  std::string units = std::string("# units, ") + kUnits, header;
  for (const EventQuantity& quantity : quantities) {
    for (const std::string& component : quantity.components) {
      units += (header.empty() ? "; " : ", ") + quantity.name + component + ": " + quantity.unit;
      header += (header.empty() ? "" : ",") + quantity.name + component;
    }
  }
  return units + "\n" + header + "\n";
}

std::string csv_lines(const std::vector<double>& records, std::size_t size) {
  fmt::memory_buffer text;
  for (std::size_t k = 0; k < records.size(); ++k) {
    fmt::format_to(std::back_inserter(text), "{}{}", records[k], (k + 1) % size == 0 ? '\n' : ',');
  }
  return fmt::to_string(text);
}

std::string csv_text(const LoggedParticles& particles) {
  std::string text = std::string("# units, ") + kUnits +
                     "; particle: 1, species: 1, diameter: a, mass: m\n"
                     "particle,species,diameter,mass\n";
  for (std::size_t i = 0; i < particles.grains.size(); ++i) {
    const Grain& grain = particles.grains[i];
    text += fmt::format("{},{},{},{}\n", i, particles.species[grain.species], 2.0 * grain.radius,
                        grain.mass);
  }
  return text;
}

namespace {

constexpr hsize_t kEventChunk = 16384;  // events

GrowingDataset dataset_of(const EventQuantity& quantity, const H5::Group& group) {
  Hdf5Shape row, chunk = {kEventChunk};
  if (quantity.components.size() > 1 || quantity.components.front() != "") {
    row.push_back(quantity.components.size());
    chunk.push_back(quantity.components.size());
  }
  GrowingDataset dataset(group, quantity.name,
                         quantity.whole ? H5::PredType::STD_I64LE : H5::PredType::IEEE_F64LE, row,
                         chunk);
  write_text(dataset.dataset(), "units", quantity.unit);
  return dataset;
}

// Appends the numbers of `count` records, from the given place in each record of `size` numbers.
void append(GrowingDataset& dataset, const std::vector<double>& records, std::size_t count,
            std::size_t size, std::size_t place, std::size_t components) {
  std::vector<double> values(count * components);
  for (std::size_t k = 0; k < count; ++k) {
    std::copy_n(&records[k * size + place], components, &values[k * components]);
  }
  dataset.append(values.data(), count);
}

// Throws RunError if not all records can be read.
void fill(const H5::H5File& file, const std::filesystem::path& records_path,
          const std::vector<EventQuantity>& quantities) {
  std::ifstream records(records_path, std::ios::binary);
  if (!records) throw RunError("cannot read " + records_path.string());
  const H5::Group root = file.openGroup("/");
  write_text(root, "units", kUnits);
  write_text(
      root, "kinds",
      "0: particles; 1: left, 2: right, 3: bottom, 4: top, 5: back, 6: front wall; "
      "7 and above: fixtures, the obstacles of the scene first; 7: the free piston of a scene "
      "with one");
  std::vector<GrowingDataset> datasets;
  for (const EventQuantity& quantity : quantities) datasets.push_back(dataset_of(quantity, root));
  const std::size_t size = record_size(quantities);
  std::vector<double> chunk(size * kEventChunk);
  const auto bytes = static_cast<std::streamsize>(chunk.size() * sizeof(double));
  while (records) {
    records.read(reinterpret_cast<char*>(chunk.data()), bytes);
    const auto count = static_cast<std::size_t>(records.gcount()) / (size * sizeof(double));
    if (count == 0) break;
    std::size_t place = 0;
    for (std::size_t k = 0; k < datasets.size(); ++k) {
      const std::size_t components = quantities[k].components.size();
      append(datasets[k], chunk, count, size, place, components);
      place += components;
    }
  }
  if (!records.eof()) throw RunError("cannot read " + records_path.string());
  file.flush(H5F_SCOPE_GLOBAL);  // the destructors would hide errors
}

}  // namespace

void write_event_file(const std::filesystem::path& path, const std::filesystem::path& records,
                      const std::vector<EventQuantity>& quantities,
                      const LoggedParticles& particles) {
  const std::uint64_t size =
      std::filesystem::file_size(records) + particles.grains.size() * 3 * sizeof(double);
  write_large_hdf5(path, size, [&](const H5::H5File& file) {
    if (!particles.species.empty()) {
      write_grains(file.createGroup("particles"), particles.species, particles.grains, "m", "a");
    }
    fill(file, records, quantities);
  });
}

template void append_record<2>(std::vector<double>&, const Domain<2>&, double,
                               const PairCollision<2>&, bool);
template void append_record<3>(std::vector<double>&, const Domain<3>&, double,
                               const PairCollision<3>&, bool);
template void append_record<2>(std::vector<double>&, const Domain<2>&, double,
                               const WallCollision<2>&, bool);
template void append_record<3>(std::vector<double>&, const Domain<3>&, double,
                               const WallCollision<3>&, bool);

}  // namespace clatter
