// VTU: VTK's XML format for unstructured grids, version 1.0.
//
// All arrays are appended as raw bytes behind the XML; where compressed, in blocks by zlib
// (vtkZLibDataCompressor), each preceded by the number of blocks, their size, the size of the last one, and
// their compressed sizes, as UInt64. Source: "VTK file formats", VTK user's guide, section "XML file
// formats".
#pragma once
#include <cstdint>
#include <filesystem>
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

/// Write the grid to a file, whole or not at all. Throws std::runtime_error naming the file and the reason.
void write_vtu(const std::filesystem::path& path, UnstructuredGrid grid, bool compress);

}  // namespace geist::output
