#include "app/results/hdf5_file.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "app/results/hdf5_writer.h"
#include "app/results/result_json.h"
#include "engine/scene/enum_names.h"

namespace clatter {

namespace {

using Json = nlohmann::ordered_json;

// The Boolean type that h5py and pandas recognise.
H5::EnumType flag_type() {
  H5::EnumType type(H5::PredType::NATIVE_INT8);
  std::int8_t value = 0;
  type.insert("FALSE", &value);
  value = 1;
  type.insert("TRUE", &value);
  return type;
}

template <class T>
void write_value(const H5::H5Object& object, const std::string& name, const H5::DataType& type,
                 const T& value) {
  object.createAttribute(name, type, H5::DataSpace()).write(type, &value);
}

template <class T>
void write_list(const H5::H5Object& object, const std::string& name, const H5::DataType& type,
                const std::vector<T>& values) {
  const H5::Attribute attribute = object.createAttribute(name, type, space_of({values.size()}));
  if (!values.empty()) attribute.write(type, values.data());
}

void write_list(const H5::H5Object& object, const std::string& name, const Json& list) {
  const auto all = [&](auto&& is) { return std::ranges::all_of(list, is); };
  if (all([](const Json& item) { return item.is_number_integer(); })) {
    write_list(object, name, H5::PredType::NATIVE_INT64, list.get<std::vector<std::int64_t>>());
  } else if (all([](const Json& item) { return item.is_number(); })) {
    write_list(object, name, H5::PredType::NATIVE_DOUBLE, list.get<std::vector<double>>());
  } else if (all([](const Json& item) { return item.is_string(); })) {
    write_texts(object, name, list.get<std::vector<std::string>>());
  } else {
    write_text(object, name, list.dump());
  }
}

// The name of an object in a list: its key name, or the names of its two species. Empty: none.
std::string item_name(const Json& item) {
  if (!item.is_object()) return "";
  if (item.contains("name") && item.at("name").is_string()) return item.at("name");
  if (!item.contains("species") || !item.at("species").is_array()) return "";
  std::string names;
  for (const Json& name : item.at("species")) {
    if (!name.is_string()) return "";
    names += (names.empty() ? "" : ",") + name.get<std::string>();
  }
  return names;
}

// Whether all items of a list are objects with different names.
bool has_named_items(const Json& list) {
  std::set<std::string> names;
  return list.is_array() && !list.empty() && std::ranges::all_of(list, [&](const Json& item) {
           const std::string name = item_name(item);
           return !name.empty() && names.insert(name).second;
         });
}

// Members that are objects become groups, as do lists of objects with names. All others are
// attributes.
void write_object(const H5::Group& group, const Json& object) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_object()) {
      write_object(group.createGroup(name), value);
    } else if (has_named_items(value)) {
      const H5::Group items = group.createGroup(name);
      for (const Json& item : value) write_object(items.createGroup(item_name(item)), item);
    } else if (value.is_array()) {
      write_list(group, name, value);
    } else if (value.is_string()) {
      write_text(group, name, value.get_ref<const std::string&>());
    } else if (value.is_boolean()) {
      write_value(group, name, flag_type(), static_cast<std::int8_t>(value.get<bool>()));
    } else if (value.is_number_unsigned()) {
      write_value(group, name, H5::PredType::NATIVE_UINT64, value.get<std::uint64_t>());
    } else if (value.is_number_integer()) {
      write_value(group, name, H5::PredType::NATIVE_INT64, value.get<std::int64_t>());
    } else {
      // JSON has null for a number that is not finite.
      const double number =
          value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
      write_value(group, name, H5::PredType::NATIVE_DOUBLE, number);
    }
  }
}

void write_series(const H5::Group& group, const Measured& measured) {
  write_dataset(group, "time", "t", measured.series.times);
  const std::string unit = unit_of(Quantity::Temperature, 2);
  write_dataset(group, "translational", unit, measured.series.temperature);
  if (measured.series.spin_temperature.empty()) return;
  write_dataset(group, "spin", unit, measured.series.spin_temperature);
}

void write_profile(const H5::Group& group, const Profile& profile) {
  write_text(group, "axis", std::string(name_of(profile.axis, kAxes)));
  write_dataset(group, "edges", "a", profile.edges);
  const H5::Group errors = group.createGroup("standard_error");
  for (std::size_t f = 0; f < profile.fields.size(); ++f) {
    std::vector<double> means, widths;
    for (const Estimate& estimate : profile.values[f]) {
      means.push_back(estimate.mean);
      widths.push_back(estimate.standard_error);
    }
    const std::string name = profile.name(f);
    const std::string unit = unit_of(profile.fields[f].quantity, profile.dimension);
    write_dataset(group, name, unit, means);
    write_dataset(errors, name, unit, widths);
  }
}

// The edges of the cells along every axis.
void write_edges(const H5::Group& group, const FieldMaps& maps) {
  for (std::size_t axis = 0; axis < maps.cell.size(); ++axis) {
    const int cells = maps.maps.front().cells[axis];
    const double length = cells * maps.cell[axis];
    std::vector<double> edges;
    for (int i = 0; i <= cells; ++i)
      edges.push_back(length * i / cells);  // equal to the edges of profiles
    write_dataset(group, std::string(kAxes[axis].name) + "_edges", "a", edges);
  }
}

Hdf5Shape shape_of(const FieldMap& map) {
  return {map.cells.rbegin(), map.cells.rend()};
}

std::string map_unit(const FieldMap& map) {
  return unit_of(map.field.quantity, static_cast<int>(map.cells.size()));
}

void write_maps(const H5::Group& group, const FieldMaps& maps, const StopRequest& stop) {
  write_edges(group, maps);
  write_dataset(group, "time", "t", {maps.begin, maps.end});
  for (const FieldMap& map : maps.maps) {
    stop.check();
    write_dataset(group, name_of(map), map_unit(map), map.values, shape_of(map));
  }
}

void write_map_series(const H5::Group& group, const std::vector<FieldMaps>& parts,
                      const StopRequest& stop) {
  write_edges(group, parts.front());
  std::vector<double> times;
  for (const FieldMaps& part : parts) times.insert(times.end(), {part.begin, part.end});
  write_dataset(group, "time", "t", times, {parts.size(), 2});
  for (std::size_t f = 0; f < parts.front().maps.size(); ++f) {
    const FieldMap& map = parts.front().maps[f];
    std::vector<double> values;
    for (const FieldMaps& part : parts) {
      stop.check();
      values.insert(values.end(), part.maps[f].values.begin(), part.maps[f].values.end());
    }
    Hdf5Shape shape = shape_of(map);
    shape.insert(shape.begin(), parts.size());
    write_dataset(group, name_of(map), map_unit(map), values, shape);
  }
}

// Removes a table from a result. The group of its dotted name remains.
void erase_table(Json& result, const ResultTable& table) {
  Json& place = result.at(estimate_pointer(table.name));
  place.erase("standard_error");
  for (const TableColumn& column : table.columns) place.erase(column.name);
}

void write_table(const H5::Group& group, const ResultTable& table) {
  const H5::Group errors = group.createGroup("standard_error");
  for (const TableColumn& column : table.columns) {
    write_dataset(group, column.name, column.unit, column.values);
    if (column.standard_errors.empty()) continue;
    write_dataset(errors, column.name, column.unit, column.standard_errors);
  }
}

void write_all(const H5::H5File& file, const Json& result, const Measured& measured,
               const StopRequest& stop) {
  Json rest = result;
  rest.erase("temperature_series");
  rest.erase("profile");
  const std::vector<ResultTable> tables = measured.tables();
  for (const ResultTable& table : tables) erase_table(rest, table);
  write_text(file.openGroup("/"), "units", kUnits);
  write_object(file.openGroup("/"), rest);
  for (const ResultTable& table : tables) {
    write_table(file.openGroup(estimate_pointer(table.name).to_string()), table);
  }
  write_series(file.createGroup("temperature_series"), measured);
  if (measured.profile) write_profile(file.createGroup("profile"), *measured.profile);
  if (!measured.maps) return;
  write_maps(file.createGroup("maps"), *measured.maps, stop);
  if (measured.map_series.empty()) return;
  write_map_series(file.createGroup("map_series"), measured.map_series, stop);
}

}  // namespace

void write_hdf5(const std::filesystem::path& path, const Json& result, const Measured& measured,
                const StopRequest& stop) {
  write_hdf5(path, [&](const H5::H5File& file) { write_all(file, result, measured, stop); });
}

}  // namespace clatter
