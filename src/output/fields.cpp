#include "output/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <list>
#include <numeric>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "output/field_list.hpp"
#include "output/file.hpp"

namespace geist::output {
namespace {

/// A part of the model that gets its own file: its name, and the fields it shows at points and cells.
struct Part {
  const char* name;
  Place points;
  std::optional<Place> cells;
};
constexpr std::size_t worth_threads = 10'000;  ///< values

constexpr std::array parts{Part{"hexahedra", Place::nodes, Place::hexahedra},
                           Part{"particles", Place::particles, {}}, Part{"ghosts", Place::ghosts, {}}};

template <class T>
std::vector<T> convert(const std::vector<double>& values) {
  std::vector<T> converted(values.size());
  for_each(
      values.size(),
      [from = values.data(), to = converted.data()](std::size_t i) { to[i] = static_cast<T>(from[i]); },
      worth_threads);
  return converted;
}

/// Makes the arrays of a simulation's fields.
struct Arrays {
  const Simulation& sim;
  const UnitSystem& units;
  Precision precision;

  DataArray make(const FieldInfo& field) const {
    const bool has_unit = field.dimension != dimension::none;
    DataArray array{std::string(field.name), field.components, field.values(sim),
                    has_unit ? units.label(field.dimension) : "", component_names(field)};
    const auto& values = std::get<std::vector<double>>(array.values);
    const bool full = field.storage == Storage::full && precision == Precision::full;
    if (field.storage == Storage::integer)
      array.values = convert<std::int32_t>(values);
    else if (!full)
      array.values = convert<float>(values);
    return array;
  }
  std::vector<DataArray> shown(Place place) const {
    std::vector<DataArray> arrays;
    for (const FieldInfo& field : fields())
      if (field.place == place && field.shown) arrays.push_back(make(field));
    return arrays;
  }
};

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

bool exists(const Part& part, const Model& model) {
  if (part.points == Place::nodes) return !model.mesh.elements.empty();
  const std::uint32_t flag = part.points == Place::particles ? site::particle : site::ghost;
  return std::any_of(model.lattices.begin(), model.lattices.end(),
                     [flag](const Lattice& lattice) { return lattice.count(flag) > 0; });
}

void add_geometry(UnstructuredGrid& grid, const Part& part, const Model& model) {
  if (part.points == Place::nodes)
    add_hexahedra(grid, model.mesh);
  else
    add_sites(grid, model, part.points == Place::particles ? site::particle : site::ghost);
}

}  // namespace

/// The fields of a step, on their way into files.
struct FieldWriter::Snapshot {
  struct File {
    std::size_t part;
    GridEncoder grid;
    File(std::size_t p, UnstructuredGrid g, bool compress, std::shared_ptr<const EncodedGeometry> geometry)
        : part(p), grid(std::move(g), compress, std::move(geometry)) {}
  };
  long step = 0;
  double time = 0;
  std::list<File> files = {};

  void work() {
    for (File& file : files) file.grid.work();
  }
};

FieldWriter::FieldWriter(std::filesystem::path directory, UnitSystem units, bool compress,
                         Precision precision)
    : directory_(std::move(directory)),
      units_(units),
      compress_(compress),
      precision_(precision),
      geometry_(parts.size()) {
  make_directory(directory_ / fields_folder);
}

FieldWriter::~FieldWriter() {
  if (written_.valid()) written_.wait();
}

void FieldWriter::write(const Simulation& sim) {
  finish();
  std::shared_ptr<Snapshot> taken = snapshot(sim);
  under_way_ = taken;
  written_ = std::async(std::launch::async, [this, taken = std::move(taken)]() mutable {
    run_anywhere();
    write(*taken);
    taken.reset();
  });
}

void FieldWriter::finish() {
  if (!written_.valid()) return;
  if (const std::shared_ptr<Snapshot> taken = under_way_.lock())
    for_each(static_cast<std::size_t>(threads()), [help = taken.get()](std::size_t) { help->work(); });
  written_.get();
}

std::shared_ptr<FieldWriter::Snapshot> FieldWriter::snapshot(const Simulation& sim) const {
  const Model& model = sim.model;
  const Arrays arrays{sim, units_, precision_};
  auto taken = std::make_shared<Snapshot>();
  taken->step = model.step, taken->time = model.time;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (!exists(parts[p], model)) continue;
    UnstructuredGrid grid;
    grid.time = model.time;
    if (!geometry_[p]) add_geometry(grid, parts[p], model);
    grid.point_data = arrays.shown(parts[p].points);
    if (parts[p].cells) grid.cell_data = arrays.shown(*parts[p].cells);
    taken->files.emplace_back(p, std::move(grid), compress_, geometry_[p]);
  }
  return taken;
}

void FieldWriter::write(Snapshot& taken) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.step == taken.step; });
  int number = 0;
  for (auto& [part, grid] : taken.files) {
    const std::string file = fmt::format("{}/{}_{:06}.vtu", fields_folder, parts[part].name, taken.step);
    geometry_[part] = grid.write(directory_ / file);
    entries_.push_back({taken.step, taken.time, number++, parts[part].name, file});
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
