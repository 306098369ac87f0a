// VTU: VTK's XML format for unstructured grids, version 1.0.
//
// All arrays are appended as raw bytes behind the XML; where compressed, in blocks by zlib
// (vtkZLibDataCompressor), each preceded by the number of blocks, their size, the size of the last one, and
// their compressed sizes, as UInt64. Source: "VTK file formats", VTK user's guide, section "XML file
// formats".
//
// Blocks whose beginning zlib makes less than a tenth smaller are stored in zlib's frame as they are: such
// numbers take it longest.
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace geist::output {

/// A named array of tuples, tuple after tuple.
struct DataArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<float>, std::vector<std::int64_t>, std::vector<std::int32_t>,
               std::vector<std::uint8_t>>
      values;
  std::string unit = {};                          ///< shown by readers that know VTK's UNITS_LABEL
  std::vector<std::string> component_names = {};  ///< none, or one for each component
};

/// VTK's cell types, those we write.
enum class Cell : std::uint8_t { vertex = 1, hexahedron = 12 };

/// Points and cells of one type, with what is known at each of them.
struct UnstructuredGrid {
  std::vector<double> points;  ///< x y z, point after point
  Cell cell = Cell::vertex;
  std::vector<std::int64_t> connectivity;  ///< points of the cells, cell after cell
  std::vector<DataArray> point_data, cell_data;
  double time = 0;
};

/// An array as it lies in a file: the XML around its offset, then a header and pieces, which look at what it
/// owns.
struct EncodedArray {
  std::string opening, ending;
  std::vector<std::uint64_t> header;
  std::vector<std::span<const std::byte>> pieces;
  DataArray values = {};  ///< empty once they are compressed
  std::unique_ptr<std::byte[]> compressed = nullptr;
  std::size_t size() const;
};

/// Encodes arrays, block by block. Whoever has time calls work(): several threads may, at once.
class Encoder {
 public:
  Encoder(std::vector<DataArray> arrays, bool compress);
  /// Encode blocks until none is left to begin with.
  void work();
  /// Finish what work() began, wait for others that are still at it, and hand over the arrays, in order.
  /// Throws std::bad_alloc.
  std::vector<EncodedArray> finish();

 private:
  /// A part of an array, where it goes to, and how long it has become.
  struct Block {
    std::span<const std::byte> source;
    std::byte* target;
    std::size_t size = 0;
  };
  void divide(EncodedArray& array);
  void assemble(EncodedArray& array, std::size_t first_block) const;
  std::vector<EncodedArray> arrays_;
  bool compress_;
  std::vector<Block> blocks_;
  std::atomic<std::size_t> next_ = 0, done_ = 0;
  std::atomic<bool> failed_ = false;
};

/// Points and cells, encoded: what many files have in common.
struct EncodedGeometry {
  std::size_t points = 0, cells = 0;
  std::vector<EncodedArray> arrays = {};  ///< Points, connectivity, offsets, types
};

/// A grid on its way into a file.
class GridEncoder {
 public:
  /// Points and cells of the grid do not count if their `geometry` is there already, from another grid.
  GridEncoder(UnstructuredGrid grid, bool compress,
              std::shared_ptr<const EncodedGeometry> geometry = nullptr);
  /// Encode as long as there is something to begin with. Several threads may call this at once.
  void work();
  /// Finish and write the file, whole or not at all. Throws std::runtime_error naming the file and the
  /// reason. Returns the geometry.
  std::shared_ptr<const EncodedGeometry> write(const std::filesystem::path& path);

 private:
  bool compress_;
  double time_;
  std::shared_ptr<const EncodedGeometry> known_;
  EncodedGeometry own_;
  Encoder point_data_, cell_data_, geometry_;
};

}  // namespace geist::output
