#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/dynamics/observer.h"
#include "engine/laws/domain.h"
#include "engine/physics/grain.h"

namespace clatter {

/// Format of an event log.
enum class EventLogFormat {
  Csv,  ///< one line per event: .csv
  Hdf5  ///< one dataset per quantity: .h5
};

/// The format of a file extension. Throws UserError that names `flag` for other extensions.
EventLogFormat event_log_format(const std::filesystem::path& file, const char* flag);

/// A quantity of an event log: a number or a vector per event.
struct EventQuantity {
  std::string name;
  std::string unit;                     ///< "1": dimensionless
  std::vector<std::string> components;  ///< suffixes of the columns, such as "_x"; {""}: a number
  bool whole = false;                   ///< whether the numbers are whole
};

/// The quantities of each event, in the order of a record. `spins`: whether particles may spin.
std::vector<EventQuantity> event_quantities(int dimension, bool spins);

/// Number of numbers in a record.
std::size_t record_size(const std::vector<EventQuantity>& quantities);

/// Appends the record of a collision of two particles, at a simulation time. Positions are wrapped
/// into the box.
template <int D>
void append_record(std::vector<double>& records, const Domain<D>& domain, double time,
                   const PairCollision<D>& collision, bool spins);
/// Appends the record of a hit of a wall. Quantities of the partner are NaN.
template <int D>
void append_record(std::vector<double>& records, const Domain<D>& domain, double time,
                   const WallCollision<D>& collision, bool spins);

/// The lines of a CSV before the events: units, then names of the columns.
std::string csv_header(const std::vector<EventQuantity>& quantities);
/// Lines of a CSV. Their numbers read back to exactly the same bits.
std::string csv_lines(const std::vector<double>& records, std::size_t size);

/// What the particles of a mixture are. A log has it once.
struct LoggedParticles {
  std::vector<std::string> species = {};  ///< names; empty: all particles are alike
  std::vector<Grain> grains = {};         ///< [N] of a mixture, otherwise empty
};

/// A table of the particles of a mixture: number, species, diameter and mass.
std::string csv_text(const LoggedParticles& particles);

/// Turns a file of records, as bytes of doubles, into compressed HDF5, with the group particles of
/// a mixture. The file `path` is replaced as a whole. Throws RunError.
void write_event_file(const std::filesystem::path& path, const std::filesystem::path& records,
                      const std::vector<EventQuantity>& quantities,
                      const LoggedParticles& particles = {});

}  // namespace clatter
