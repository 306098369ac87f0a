#include "output/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "output/file.hpp"

namespace geist::output {
namespace {

using Bytes = std::span<const std::byte>;

/// One array as it will lie in the file: header, then the pieces one after the other.
struct Appended {
  std::vector<std::uint64_t> header;
  std::vector<Bytes> pieces;
  std::unique_ptr<std::byte[]> compressed = nullptr;  ///< what the pieces look at, if not at the values

  std::size_t size() const {
    std::size_t bytes = header.size() * sizeof header[0];
    for (const Bytes& piece : pieces) bytes += piece.size();
    return bytes;
  }
};

Bytes bytes_of(const DataArray& array) {
  return std::visit([](const auto& v) { return std::as_bytes(std::span(v)); }, array.values);
}

Appended append_raw(Bytes bytes) { return {{bytes.size()}, {bytes}}; }

/// The blocks are compressed in parallel, each into its own part of one buffer.
Appended append_compressed(Bytes bytes) {
  constexpr std::size_t block = 1 << 18;
  const std::size_t blocks = (bytes.size() + block - 1) / block, room = compressBound(block);
  Appended a{
      {blocks, block, bytes.size() % block}, {}, std::unique_ptr<std::byte[]>(new std::byte[blocks * room])};
  std::vector<uLongf> sizes(blocks, room);
  std::byte* const target = a.compressed.get();
  uLongf* const size = sizes.data();
  std::atomic<bool> failed = false;
  std::atomic<bool>* const any_failed = &failed;
  for_each(blocks, [=](std::size_t b) {
    const Bytes source = bytes.subspan(b * block, std::min(block, bytes.size() - b * block));
    const int fastest = 1;
    if (compress2(reinterpret_cast<Bytef*>(target + b * room), size + b,
                  reinterpret_cast<const Bytef*>(source.data()), source.size(), fastest) != Z_OK)
      *any_failed = true;
  });
  if (failed) throw std::bad_alloc();  // the only error of compress2 with enough room
  for (std::size_t b = 0; b < blocks; ++b) {
    a.header.push_back(sizes[b]);
    a.pieces.emplace_back(target + b * room, sizes[b]);
  }
  return a;
}

const char* type_name(const DataArray& array) {
  constexpr const char* names[] = {"Float64", "Float32", "Int64", "Int32", "UInt8"};
  return names[array.values.index()];
}

/// The XML that points at the arrays, and the arrays, which must outlive it.
class Document {
 public:
  explicit Document(bool compress) : compress_(compress) {}
  std::string xml;

  void array(const DataArray& a) {
    xml += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type_name(a), a.name,
                       a.components);
    for (std::size_t c = 0; c < a.component_names.size(); ++c)
      xml += fmt::format(" ComponentName{}=\"{}\"", c, a.component_names[c]);
    xml += fmt::format(" format=\"appended\" offset=\"{}\"", offset_);
    if (a.unit.empty())
      xml += "/>\n";
    else
      xml += fmt::format(
          "><InformationKey name=\"UNITS_LABEL\" location=\"vtkDataArray\">{}</InformationKey></DataArray>\n",
          a.unit);
    appended_.push_back(compress_ ? append_compressed(bytes_of(a)) : append_raw(bytes_of(a)));
    offset_ += appended_.back().size();
  }
  void section(const char* name, const std::vector<const DataArray*>& arrays) {
    xml += fmt::format("<{}>\n", name);
    for (const DataArray* a : arrays) array(*a);
    xml += fmt::format("</{}>\n", name);
  }
  void section(const char* name, const std::vector<DataArray>& arrays) {
    std::vector<const DataArray*> list;
    for (const DataArray& a : arrays) list.push_back(&a);
    section(name, list);
  }
  void write(File& file) const {
    file.write(xml);
    file.write("<AppendedData encoding=\"raw\">\n_");
    for (const Appended& a : appended_) {
      file.write(a.header.data(), a.header.size() * sizeof a.header[0]);
      for (const Bytes& piece : a.pieces) file.write(piece.data(), piece.size());
    }
    file.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  bool compress_;
  std::vector<Appended> appended_;
  std::size_t offset_ = 0;
};

std::string opening(const UnstructuredGrid& grid, std::size_t cells, bool compress) {
  const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\"{}>\n"
      "<UnstructuredGrid>\n"
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      order, compress ? " compressor=\"vtkZLibDataCompressor\"" : "", grid.time, grid.points.size() / 3,
      cells);
}

}  // namespace

void write_vtu(const std::filesystem::path& path, UnstructuredGrid grid, bool compress) {
  const std::size_t corners = grid.cell == Cell::vertex ? 1 : 8, cells = grid.connectivity.size() / corners;
  std::vector<std::int64_t> ends(cells);
  for (std::size_t c = 0; c < cells; ++c) ends[c] = static_cast<std::int64_t>((c + 1) * corners);

  Document document(compress);
  document.xml = opening(grid, cells, compress);
  const DataArray points{"Points", 3, std::move(grid.points)},
      connectivity{"connectivity", 1, std::move(grid.connectivity)}, offsets{"offsets", 1, std::move(ends)},
      types{"types", 1, std::vector<std::uint8_t>(cells, static_cast<std::uint8_t>(grid.cell))};
  document.section("PointData", grid.point_data);
  document.section("CellData", grid.cell_data);
  document.section("Points", {&points});
  document.section("Cells", {&connectivity, &offsets, &types});
  document.xml += "</Piece>\n</UnstructuredGrid>\n";

  AtomicFile file(path);
  document.write(file.file());
  file.commit();
}

}  // namespace geist::output
