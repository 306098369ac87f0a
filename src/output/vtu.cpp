#include "output/vtu.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <new>
#include <utility>

#include "output/file.hpp"

namespace geist::output {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t block_size = 1 << 18;

std::size_t blocks_of(Bytes bytes) { return (bytes.size() + block_size - 1) / block_size; }

Bytes bytes_of(const DataArray& array) {
  return std::visit([](const auto& v) { return std::as_bytes(std::span(v)); }, array.values);
}

const char* type_name(const DataArray& array) {
  constexpr const char* names[] = {"Float64", "Float32", "Int64", "Int32", "UInt8"};
  return names[array.values.index()];
}

/// What stands in the XML before and after an array's offset.
EncodedArray described(DataArray array) {
  EncodedArray a;
  a.opening = fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"", type_name(array),
                          array.name, array.components);
  for (std::size_t c = 0; c < array.component_names.size(); ++c)
    a.opening += fmt::format(" ComponentName{}=\"{}\"", c, array.component_names[c]);
  a.ending = array.unit.empty() ? "/>\n"
                                : fmt::format(
                                      "><InformationKey name=\"UNITS_LABEL\" "
                                      "location=\"vtkDataArray\">{}</InformationKey></DataArray>\n",
                                      array.unit);
  a.values = std::move(array);
  return a;
}

/// zlib's frame around the source; returns its length, 0 if there was no memory.
std::size_t deflated(Bytes source, std::byte* target, int level) {
  uLongf size = compressBound(block_size);
  const int status = compress2(reinterpret_cast<Bytef*>(target), &size,
                               reinterpret_cast<const Bytef*>(source.data()), source.size(), level);
  return status == Z_OK ? size : 0;
}

/// Its beginning tells whether a block is noise.
bool is_noise(Bytes source, std::byte* scratch) {
  constexpr std::size_t sample = 1 << 13;
  constexpr double worth = 0.9;
  if (source.size() <= sample) return false;
  return static_cast<double>(deflated(source.first(sample), scratch, Z_BEST_SPEED)) > worth * sample;
}

/// The XML that points at the arrays, and the arrays, which must outlive it.
class Document {
 public:
  std::string xml;

  void section(const char* name, std::span<const EncodedArray> arrays) {
    xml += fmt::format("<{}>\n", name);
    for (const EncodedArray& a : arrays) {
      xml += fmt::format("{} format=\"appended\" offset=\"{}\"{}", a.opening, offset_, a.ending);
      appended_.push_back(&a);
      offset_ += a.size();
    }
    xml += fmt::format("</{}>\n", name);
  }
  void write(File& file) const {
    file.write(xml);
    file.write("<AppendedData encoding=\"raw\">\n_");
    for (const EncodedArray* a : appended_) {
      file.write(a->header.data(), a->header.size() * sizeof a->header[0]);
      for (const Bytes& piece : a->pieces) file.write(piece.data(), piece.size());
    }
    file.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  std::vector<const EncodedArray*> appended_;
  std::size_t offset_ = 0;
};

std::string opening(const EncodedGeometry& geometry, double time, bool compressed) {
  const char* order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"{}\" header_type=\"UInt64\"{}>\n"
      "<UnstructuredGrid>\n"
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
      order, compressed ? " compressor=\"vtkZLibDataCompressor\"" : "", time, geometry.points,
      geometry.cells);
}

std::size_t corners_of(Cell cell) { return cell == Cell::vertex ? 1 : 8; }

EncodedGeometry sizes_of(const UnstructuredGrid& grid) {
  return {grid.points.size() / 3, grid.connectivity.size() / corners_of(grid.cell)};
}

std::vector<DataArray> geometry_arrays(UnstructuredGrid grid) {
  const std::size_t corners = corners_of(grid.cell), cells = grid.connectivity.size() / corners;
  std::vector<std::int64_t> ends(cells);
  for (std::size_t c = 0; c < cells; ++c) ends[c] = static_cast<std::int64_t>((c + 1) * corners);
  std::vector<std::uint8_t> types(cells, static_cast<std::uint8_t>(grid.cell));
  std::vector<DataArray> arrays;
  arrays.push_back({"Points", 3, std::move(grid.points)});
  arrays.push_back({"connectivity", 1, std::move(grid.connectivity)});
  arrays.push_back({"offsets", 1, std::move(ends)});
  arrays.push_back({"types", 1, std::move(types)});
  return arrays;
}

}  // namespace

std::size_t EncodedArray::size() const {
  std::size_t bytes = header.size() * sizeof header[0];
  for (const Bytes& piece : pieces) bytes += piece.size();
  return bytes;
}

Encoder::Encoder(std::vector<DataArray> arrays, bool compress) : compress_(compress) {
  for (DataArray& array : arrays) {
    arrays_.push_back(described(std::move(array)));
    if (compress_) divide(arrays_.back());
  }
}

/// Every block has its own part of one buffer.
void Encoder::divide(EncodedArray& array) {
  const Bytes bytes = bytes_of(array.values);
  const std::size_t blocks = blocks_of(bytes), room = compressBound(block_size);
  array.compressed.reset(new std::byte[blocks * room]);
  for (std::size_t b = 0; b < blocks; ++b)
    blocks_.push_back({bytes.subspan(b * block_size, std::min(block_size, bytes.size() - b * block_size)),
                       array.compressed.get() + b * room});
}

void Encoder::work() {
  for (std::size_t b; (b = next_++) < blocks_.size();) {
    Block& block = blocks_[b];
    const bool noise = is_noise(block.source, block.target);
    block.size = deflated(block.source, block.target, noise ? Z_NO_COMPRESSION : Z_BEST_SPEED);
    if (block.size == 0) failed_ = true;
    ++done_, done_.notify_all();
  }
}

void Encoder::assemble(EncodedArray& array, std::size_t first_block) const {
  const Bytes bytes = bytes_of(array.values);
  if (!compress_) {
    array.header = {bytes.size()}, array.pieces = {bytes};
    return;
  }
  const std::size_t blocks = blocks_of(bytes);
  array.header = {blocks, block_size, bytes.size() % block_size};
  for (std::size_t b = first_block; b < first_block + blocks; ++b) {
    array.header.push_back(blocks_[b].size);
    array.pieces.emplace_back(blocks_[b].target, blocks_[b].size);
  }
  array.values = {};
}

std::vector<EncodedArray> Encoder::finish() {
  work();
  for (std::size_t done; (done = done_) < blocks_.size();) done_.wait(done);
  if (failed_) throw std::bad_alloc();
  std::size_t first_block = 0;
  for (EncodedArray& array : arrays_) {
    const std::size_t blocks = blocks_of(bytes_of(array.values));
    assemble(array, first_block);
    first_block += blocks;
  }
  return std::move(arrays_);
}

GridEncoder::GridEncoder(UnstructuredGrid grid, bool compress,
                         std::shared_ptr<const EncodedGeometry> geometry)
    : compress_(compress),
      time_(grid.time),
      known_(std::move(geometry)),
      own_(sizes_of(grid)),
      point_data_(std::move(grid.point_data), compress),
      cell_data_(std::move(grid.cell_data), compress),
      geometry_(known_ ? std::vector<DataArray>{} : geometry_arrays(std::move(grid)), compress) {}

void GridEncoder::work() { point_data_.work(), cell_data_.work(), geometry_.work(); }

std::shared_ptr<const EncodedGeometry> GridEncoder::write(const std::filesystem::path& path) {
  const auto point_data = point_data_.finish(), cell_data = cell_data_.finish();
  if (!known_) {
    own_.arrays = geometry_.finish();
    known_ = std::make_shared<const EncodedGeometry>(std::move(own_));
  }
  const std::span<const EncodedArray> geometry(known_->arrays);
  Document document;
  document.xml = opening(*known_, time_, compress_);
  document.section("PointData", point_data);
  document.section("CellData", cell_data);
  document.section("Points", geometry.first(1));
  document.section("Cells", geometry.subspan(1));
  document.xml += "</Piece>\n</UnstructuredGrid>\n";
  AtomicFile file(path);
  document.write(file.file());
  file.commit();
  return known_;
}

}  // namespace geist::output
