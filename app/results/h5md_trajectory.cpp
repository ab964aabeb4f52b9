#include "app/results/h5md_trajectory.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "app/results/h5md_reader.h"
#include "app/results/hdf5_writer.h"
#include "app/results/isolated_hdf5.h"
#include "app/results/three_axes.h"
#include "engine/error.h"
#include "engine/scene/field.h"
#include "engine/system/write_file.h"

namespace clatter {

namespace {

constexpr hsize_t kH5mdChunk = 8192;  // particles of one frame, or of several

// A record is a frame as doubles: number, time, tilt, and the vectors of each quantity.
constexpr std::size_t kRecordHead = 3;

std::vector<std::string> h5md_quantities(bool spins) {
  std::vector<std::string> names = {"position", "velocity", "image"};
  if (spins) names.push_back("angular_velocity");
  return names;
}

std::size_t h5md_record_size(std::size_t particles, bool spins) {
  return kRecordHead + h5md_quantities(spins).size() * 3 * particles;
}

std::string_view raw_bytes(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

// Writes the records of a complete file into a new file.
void copy_records(const std::filesystem::path& path, std::size_t particles, bool spins,
                  const std::filesystem::path& copy) {
  const H5mdReader reader(path);
  GrowingFile records(copy, 0);
  for (std::size_t k = 0; k < reader.frames(); ++k) {
    std::vector<double> record = {reader.step(k), reader.time(k), reader.tilt(k)};
    for (const std::string& name : h5md_quantities(spins)) {
      const std::vector<double> numbers = reader.vectors(name, k);
      record.insert(record.end(), numbers.begin(), numbers.end());
    }
    if (record.size() != h5md_record_size(particles, spins)) break;  // of another run
    records.append(raw_bytes(record));
  }
  records.close();
}

// Rebuilds the records of a complete file, all or none. A part of them would hide the complete file
// from the next attempt.
void restore_records(const std::filesystem::path& path, std::size_t particles, bool spins) {
  const std::filesystem::path target = frames_path(path, TrajectoryFormat::H5md);
  NewFile made = new_file_beside(target);
  if (!made.file) throw RunError("cannot write " + target.string() + ": " + std::strerror(errno));
  made.file.close();
  try {
    read_hdf5_apart(path, [&] {
      copy_records(path, particles, spins, made.path);
      return std::string();
    });
    rename_synced(made.path, target);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(made.path, ignored);
    throw;
  }
}

void write_head(const H5::H5File& file) {
  const H5::Group head = file.createGroup("h5md");
  const hsize_t two = 2;
  const std::array<int, 2> version = {1, 1};
  head.createAttribute("version", H5::PredType::STD_I32LE, H5::DataSpace(1, &two))
      .write(H5::PredType::NATIVE_INT, version.data());
  write_text(head.createGroup("author"), "name", "unknown");
  const H5::Group creator = head.createGroup("creator");
  write_text(creator, "name", "clatter");
  write_text(creator, "version", CLATTER_VERSION);
  write_text(file.openGroup("/"), "units", kUnits);
}

// The box of a trajectory, for all frames.
template <int D>
H5::Group write_box(const H5::Group& particles, const Model<D>& model) {
  const H5::Group box = particles.createGroup("box");
  const int dimension = 3;
  box.createAttribute("dimension", H5::PredType::STD_I32LE, H5::DataSpace())
      .write(H5::PredType::NATIVE_INT, &dimension);
  std::vector<std::string> boundary;
  for (int axis = 0; axis < 3; ++axis) {
    boundary.emplace_back(is_periodic(model, axis) ? "periodic" : "none");
  }
  write_texts(box, "boundary", boundary);
  return box;
}

}  // namespace

template <int D>
H5mdTrajectory<D>::H5mdTrajectory(const std::filesystem::path& path, const Model<D>& model,
                                  TrajectoryParticles particles, std::uint64_t bytes)
    : path_(path), model_(model), particles_(std::move(particles)) {
  std::error_code ignored;
  if (bytes > 0 && !std::filesystem::exists(frames_path(path, TrajectoryFormat::H5md), ignored) &&
      std::filesystem::exists(path, ignored)) {
    restore_records(path, particles_.count, particles_.spins);
  }
  records_.emplace(frames_path(path, TrajectoryFormat::H5md), bytes);
}

template <int D>
void H5mdTrajectory<D>::add(const TrajectoryFrame<D>& frame) {
  std::vector<double> record = {static_cast<double>(frame.number), frame.time, frame.tilt};
  const auto add_vectors = [&](const auto& vectors) {
    for (const auto& vector : vectors) {
      for (const auto number : in_space(vector)) record.push_back(static_cast<double>(number));
    }
  };
  add_vectors(frame.state.positions);
  add_vectors(frame.state.velocities);
  add_vectors(frame.images);
  if (particles_.spins) add_vectors(frame.state.spins);
  records_->append(raw_bytes(record));
}

template <int D>
void H5mdTrajectory<D>::finish() {
  records_->sync();
  std::ifstream records(frames_path(path_, TrajectoryFormat::H5md), std::ios::binary);
  if (!records)
    throw RunError("cannot read " + frames_path(path_, TrajectoryFormat::H5md).string());
  write_large_hdf5(path_, records_->bytes(), [&](const H5::H5File& file) {
    write_head(file);
    const H5::Group all = file.createGroup("particles").createGroup("all");
    const H5::Group box = write_box(all, model_);
    const std::size_t particles = particles_.count;
    const bool spins = particles_.spins;
    if (particles_.is_mixture()) {
      write_grains(all, particles_.species, particles_.grains, "", "");
    } else {
      write_dataset(all, "mass", "", std::vector<double>(particles, 1.0));
      write_dataset(all, "diameter", "", std::vector<double>(particles, model_.diameter));
    }

    const hsize_t in_chunk = std::clamp<hsize_t>(particles, 1, kH5mdChunk);
    const Hdf5Shape numbers = {kH5mdChunk}, vectors = {kH5mdChunk / in_chunk, in_chunk, 3};
    const H5::DataType real = H5::PredType::IEEE_F64LE, whole = H5::PredType::STD_I64LE;
    const H5::Group edges = box.createGroup("edges");
    GrowingDataset step(edges, "step", whole, {}, numbers), time(edges, "time", real, {}, numbers);
    GrowingDataset edge(edges, "value", real, {3, 3}, {kH5mdChunk / 9, 3, 3});
    std::vector<GrowingDataset> values;
    for (const std::string& name : h5md_quantities(spins)) {
      const H5::Group element = all.createGroup(name);
      // Elements of the same frames share their steps and times.
      for (const char* shared : {"step", "time"}) {
        all.link(H5L_TYPE_HARD, std::string("box/edges/") + shared, name + '/' + shared);
      }
      values.emplace_back(element, "value", name == "image" ? whole : real, Hdf5Shape{particles, 3},
                          vectors);
    }

    const std::array<double, 3> box_size = extents(model_);
    std::array<double, 9> corners = {};  // the vectors of the edges, row by row
    for (std::size_t axis = 0; axis < 3; ++axis) corners[4 * axis] = box_size[axis];
    std::vector<double> record(h5md_record_size(particles, spins));
    const auto size = static_cast<std::streamsize>(record.size() * sizeof(double));
    while (records.read(reinterpret_cast<char*>(record.data()), size)) {
      step.append(&record[0], 1);
      time.append(&record[1], 1);
      corners[3] = record[2];
      edge.append(corners.data(), 1);
      for (std::size_t k = 0; k < values.size(); ++k) {
        values[k].append(record.data() + kRecordHead + k * 3 * particles, 1);
      }
    }
  });
  records_->close();
  std::error_code ignored;
  std::filesystem::remove(frames_path(path_, TrajectoryFormat::H5md), ignored);
}

template class H5mdTrajectory<2>;
template class H5mdTrajectory<3>;

}  // namespace clatter
