#include "output/fields.hpp"

#include <fmt/format.h>

#include <array>
#include <numeric>
#include <optional>
#include <utility>

#include "output/field_list.hpp"
#include "output/file.hpp"
#include "output/vtu.hpp"

namespace geist::output {
namespace {

/// A part of the model that gets its own file: its name, and the fields it shows at points and cells.
struct Part {
  const char* name;
  Place points;
  std::optional<Place> cells;
};
constexpr std::array parts{Part{"hexahedra", Place::nodes, Place::hexahedra},
                           Part{"particles", Place::particles, {}}, Part{"ghosts", Place::ghosts, {}}};

template <class T>
std::vector<T> convert(const std::vector<double>& values) {
  std::vector<T> converted(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) converted[i] = static_cast<T>(values[i]);
  return converted;
}

DataArray make_array(const FieldInfo& field, const Simulation& sim, const UnitSystem& units) {
  const bool has_unit = field.dimension != dimension::none;
  DataArray array{std::string(field.name), field.components, field.values(sim),
                  has_unit ? units.label(field.dimension) : "", component_names(field)};
  const auto& values = std::get<std::vector<double>>(array.values);
  if (field.storage == Storage::single) array.values = convert<float>(values);
  if (field.storage == Storage::integer) array.values = convert<std::int32_t>(values);
  return array;
}

std::vector<DataArray> shown_fields(Place place, const Simulation& sim, const UnitSystem& units) {
  std::vector<DataArray> arrays;
  for (const FieldInfo& field : fields())
    if (field.place == place && field.shown) arrays.push_back(make_array(field, sim, units));
  return arrays;
}

void add_point(UnstructuredGrid& grid, Vec3 point) {
  for (int c = 0; c < 3; ++c) grid.points.push_back(point[c]);
}

void add_hexahedra(UnstructuredGrid& grid, const Mesh& mesh) {
  grid.cell = Cell::hexahedron;
  for (const Vec3& point : mesh.points) add_point(grid, point);
  for (const auto& element : mesh.elements)
    grid.connectivity.insert(grid.connectivity.end(), element.begin(), element.end());
}

void add_sites(UnstructuredGrid& grid, const Model& model, std::uint32_t flag) {
  grid.cell = Cell::vertex;
  for (const Lattice& lattice : model.lattices)
    for (std::size_t s = 0; s < lattice.word.size(); ++s)
      if (lattice.is(s, flag)) add_point(grid, lattice.grid.centre(s));
  grid.connectivity.resize(grid.points.size() / 3);
  std::iota(grid.connectivity.begin(), grid.connectivity.end(), 0);
}

/// Geometry of a part; without cells where the model has no such part.
UnstructuredGrid geometry(const Part& part, const Model& model) {
  UnstructuredGrid grid;
  grid.time = model.time;
  if (part.points == Place::nodes)
    add_hexahedra(grid, model.mesh);
  else
    add_sites(grid, model, part.points == Place::particles ? site::particle : site::ghost);
  return grid;
}

}  // namespace

FieldWriter::FieldWriter(std::filesystem::path directory, UnitSystem units, bool compress)
    : directory_(std::move(directory)), units_(units), compress_(compress) {
  make_directory(directory_ / fields_folder);
}

void FieldWriter::write(const Simulation& sim) {
  const Model& model = sim.model;
  std::erase_if(entries_, [&](const Entry& entry) { return entry.step == model.step; });
  int number = 0;
  for (const Part& part : parts) {
    UnstructuredGrid grid = geometry(part, model);
    if (grid.connectivity.empty()) continue;
    grid.point_data = shown_fields(part.points, sim, units_);
    if (part.cells) grid.cell_data = shown_fields(*part.cells, sim, units_);
    const std::string file = fmt::format("{}/{}_{:06}.vtu", fields_folder, part.name, model.step);
    write_vtu(directory_ / file, std::move(grid), compress_);
    entries_.push_back({model.step, model.time, number++, part.name, file});
  }
  write_collection();
}

void FieldWriter::write_collection() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const Entry& entry : entries_)
    text += fmt::format("<DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                        entry.time, entry.part, entry.name, entry.file);
  text += "</Collection>\n</VTKFile>\n";
  write_whole(directory_ / fields_name, text);
}

}  // namespace geist::output
