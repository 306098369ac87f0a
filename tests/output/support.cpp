#include "output/support.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>
#include <zlib.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

namespace geist::testing {

namespace fs = std::filesystem;

FullDisk::FullDisk(std::size_t bytes) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  before_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
}
FullDisk::~FullDisk() {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = before_;
  setrlimit(RLIMIT_FSIZE, &limit);
}

namespace {

Mesh two_cubes() {
  Mesh mesh;
  for (int x = 0; x < 3; ++x)
    for (int z = 0; z < 2; ++z)
      for (int y = 0; y < 2; ++y) mesh.points.push_back({double(x), double(y), double(z)});
  const auto node = [](int x, int y, int z) { return 4 * x + 2 * z + y; };
  for (int x = 0; x < 2; ++x)
    mesh.elements.push_back({node(x, 0, 0), node(x + 1, 0, 0), node(x + 1, 1, 0), node(x, 1, 0),
                             node(x, 0, 1), node(x + 1, 0, 1), node(x + 1, 1, 1), node(x, 1, 1)});
  mesh.regions.push_back(
      {.name = "cubes", .material = {"rubber", 1, 10, 0.25}, .formulation = "full", .count = 2});
  finish(mesh);
  for (std::size_t i = 0; i < mesh.nodes(); ++i)
    for (int c = 0; c < 3; ++c) {
      mesh.u[c][i] = 1e-3 / (1.0 + 3.0 * double(i) + c);
      mesh.v[c][i] = double(i) + 0.25 * c, mesh.v_before[c][i] = double(i) - 0.25 * c;
    }
  return mesh;
}

Lattice small_lattice() {
  Lattice lattice;
  lattice.name = "grains";
  lattice.material = {"rubber", 1, 10, 0.25};
  lattice.grid = {4, 2, 2, {1.75, 0.25, 0.25}, 0.5};
  lattice.mass = 0.125, lattice.inertia = 0.0125;
  lattice.word.assign(lattice.grid.size(), 0);
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 4; ++i) {
        const std::size_t s = lattice.grid.index(i, j, k);
        lattice.word[s] = i == 0 ? site::ghost : site::particle | site::free;
        if (i == 0) lattice.ghosts.push_back({s, 1, {}, {}});
      }
  connect(lattice);
  finish(lattice);
  list_sites(lattice, {});
  for (std::size_t s = 0; s < lattice.grid.size(); ++s)
    for (int c = 0; c < 6 && lattice.word[s]; ++c) {
      lattice.motion[c][s] = 1e-4 * double(s) + 1e-6 * c;
      lattice.velocity[c][s] = double(s) + c, lattice.velocity_before[c][s] = double(s) - c;
    }
  return lattice;
}

std::map<std::string, std::string> attributes(const std::string& tag) {
  static const std::regex pattern("(\\w+)=\"([^\"]*)\"");
  std::map<std::string, std::string> found;
  for (std::sregex_iterator it(tag.begin(), tag.end(), pattern), end; it != end; ++it)
    found[(*it)[1]] = (*it)[2];
  return found;
}

std::vector<std::uint64_t> words(const std::string& bytes, std::size_t at, std::size_t n) {
  std::vector<std::uint64_t> list(n);
  std::memcpy(list.data(), bytes.data() + at, 8 * n);
  return list;
}

std::string inflate_blocks(const std::string& bytes, std::size_t at) {
  const auto head = words(bytes, at, 3);
  const std::uint64_t blocks = head[0], block = head[1], last = head[2];
  const auto sizes = words(bytes, at + 24, blocks);
  at += 24 + 8 * blocks;
  std::string whole;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    std::string part(b + 1 == blocks && last ? last : block, '\0');
    uLongf size = part.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(part.data()), &size,
                         reinterpret_cast<const Bytef*>(bytes.data() + at), sizes[b]),
              Z_OK);
    EXPECT_EQ(size, part.size());
    whole += part, at += sizes[b];
  }
  return whole;
}

template <class T>
std::vector<double> numbers(const std::string& bytes) {
  std::vector<T> typed(bytes.size() / sizeof(T));
  std::memcpy(typed.data(), bytes.data(), bytes.size());
  return {typed.begin(), typed.end()};
}

std::vector<double> decode(const std::string& type, const std::string& bytes) {
  if (type == "Float64") return numbers<double>(bytes);
  if (type == "Float32") return numbers<float>(bytes);
  if (type == "Int64") return numbers<std::int64_t>(bytes);
  if (type == "Int32") return numbers<std::int32_t>(bytes);
  EXPECT_EQ(type, "UInt8");
  return numbers<std::uint8_t>(bytes);
}

}  // namespace

Model small_model() {
  Model model;
  model.mesh = two_cubes();
  model.lattices.push_back(small_lattice());
  model.time = 0.125, model.step = 120;
  return model;
}

Simulation small_simulation() {
  Simulation sim;
  sim.model = small_model();
  return sim;
}

ReadGrid read_vtu(const fs::path& path) {
  const std::string text = read_text(path), mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t data = text.find(mark);
  if (data == text.npos) throw std::runtime_error("no appended data");
  const std::string appended = text.substr(data + mark.size());
  const bool compressed = text.find("compressor=\"vtkZLibDataCompressor\"") < data;
  ReadGrid grid;
  std::string section, line;
  for (std::istringstream xml(text.substr(0, data)); std::getline(xml, line);) {
    auto a = attributes(line);
    if (line.starts_with("<Piece"))
      grid.points = std::stoul(a["NumberOfPoints"]), grid.cells = std::stoul(a["NumberOfCells"]);
    if (!line.starts_with("<DataArray")) section = line.substr(1, line.find('>') - 1);
    if (a["Name"] == "TimeValue") grid.time = std::stod(line.substr(line.find('>') + 1));
    if (a["format"] != "appended") continue;
    const std::size_t at = std::stoul(a["offset"]);
    const std::string bytes =
        compressed ? inflate_blocks(appended, at) : appended.substr(at + 8, words(appended, at, 1)[0]);
    ReadArray array{a["type"], "", std::stoi(a["NumberOfComponents"]), decode(a["type"], bytes)};
    std::smatch unit;
    if (std::regex_search(line, unit, std::regex("UNITS_LABEL[^>]*>([^<]*)<"))) array.unit = unit[1];
    grid.arrays[section + "/" + a["Name"]] = array;
  }
  return grid;
}

}  // namespace geist::testing
