#include "output/vtu.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <random>

#include "output/support.hpp"

namespace geist::output {
namespace {

using geist::testing::error_of;
using geist::testing::FullDisk;
using geist::testing::read_vtu;
using geist::testing::Scratch;

UnstructuredGrid points_with_values(std::size_t n) {
  UnstructuredGrid grid;
  std::vector<double> doubles;
  std::vector<float> floats;
  std::vector<std::int32_t> integers;
  for (std::size_t i = 0; i < n; ++i) {
    for (int c = 0; c < 3; ++c) grid.points.push_back(0.1 * double(i) + c);
    grid.connectivity.push_back(static_cast<std::int64_t>(i));
    for (int c = 0; c < 2; ++c) doubles.push_back(1.0 / (1.0 + double(2 * i) + c));
    floats.push_back(static_cast<float>(i) / 3), integers.push_back(-static_cast<std::int32_t>(i));
  }
  grid.point_data = {{"pair", 2, doubles, "mm", {"a", "b"}}, {"single", 1, floats}};
  grid.cell_data = {{"count", 1, integers}};
  grid.time = 1.0 / 3;
  return grid;
}

class VtuFile : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(, VtuFile, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "compressed" : "raw"; });

TEST_P(VtuFile, GivesBackWhatWasWritten) {
  const Scratch scratch;
  for (const std::size_t n : {1u, 1000u, 32768u, 70001u}) {  // 32768: whole blocks; 70001: a short last block
    const UnstructuredGrid grid = points_with_values(n);
    GridEncoder(grid, GetParam()).write(scratch / "a.vtu");
    auto read = read_vtu(scratch / "a.vtu");
    EXPECT_EQ(read.points, n);
    EXPECT_EQ(read.cells, n);
    EXPECT_EQ(read.time, grid.time);
    EXPECT_EQ(read.arrays["Points/Points"].values, grid.points);
    EXPECT_EQ(read.arrays["PointData/pair"].values, std::get<0>(grid.point_data[0].values));
    EXPECT_EQ(read.arrays["PointData/pair"].components, 2);
    EXPECT_EQ(read.arrays["PointData/pair"].unit, "mm");
    EXPECT_EQ(read.arrays["PointData/single"].type, "Float32");
    EXPECT_EQ(read.arrays["PointData/single"].values.back(), std::get<1>(grid.point_data[1].values).back());
    EXPECT_EQ(read.arrays["CellData/count"].values.back(), 1 - double(n));
    EXPECT_EQ(read.arrays["Cells/connectivity"].values.back(), double(n) - 1);
    EXPECT_EQ(read.arrays["Cells/offsets"].values.back(), double(n));
    EXPECT_EQ(read.arrays["Cells/types"].values, std::vector<double>(n, 1));
  }
}

TEST_P(VtuFile, HexahedraHaveEightCorners) {
  const Scratch scratch;
  UnstructuredGrid grid = points_with_values(8);
  grid.cell = Cell::hexahedron, grid.cell_data.clear();
  GridEncoder(grid, GetParam()).write(scratch / "a.vtu");
  auto read = read_vtu(scratch / "a.vtu");
  EXPECT_EQ(read.cells, 1u);
  EXPECT_EQ(read.arrays["Cells/offsets"].values, std::vector<double>{8});
  EXPECT_EQ(read.arrays["Cells/types"].values, std::vector<double>{12});
}

TEST_P(VtuFile, FullDiskLeavesNothingBehind) {
  const Scratch scratch;
  const auto path = scratch / "a.vtu";
  std::string error;
  {
    const FullDisk full(100'000);
    error = error_of([&] { GridEncoder(points_with_values(70001), GetParam()).write(path); });
  }
  EXPECT_EQ(error, "cannot write " + path.string() + ": File too large");
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path));
}

TEST(Vtu, CompressionSavesSpace) {
  const Scratch scratch;
  GridEncoder(points_with_values(70001), false).write(scratch / "raw.vtu");
  GridEncoder(points_with_values(70001), true).write(scratch / "compressed.vtu");
  EXPECT_LT(2 * file_size(scratch / "compressed.vtu"), file_size(scratch / "raw.vtu"));
}

TEST(Vtu, NoiseIsStoredAsItIs) {
  const Scratch scratch;
  UnstructuredGrid grid = points_with_values(70001);
  std::mt19937_64 random(5);
  auto& values = std::get<std::vector<double>>(grid.point_data[0].values);
  for (double& v : values) v = std::bit_cast<double>((random() >> 12) | 0x3FF0000000000000ull);  // in [1, 2)
  GridEncoder(grid, true).write(scratch / "noise.vtu");
  EXPECT_EQ(read_vtu(scratch / "noise.vtu").arrays["PointData/pair"].values, values);
  const std::string some(reinterpret_cast<const char*>(values.data()), 1000 * sizeof(double));
  EXPECT_NE(testing::read_text(scratch / "noise.vtu").find(some), std::string::npos);
}

TEST(Vtu, GridsShareTheirGeometry) {
  const Scratch scratch;
  GridEncoder first(points_with_values(1000), true);
  const auto geometry = first.write(scratch / "a.vtu");
  UnstructuredGrid values = points_with_values(1000);
  values.points.clear(), values.connectivity.clear();
  GridEncoder(std::move(values), true, geometry).write(scratch / "b.vtu");
  EXPECT_EQ(testing::read_text(scratch / "a.vtu"), testing::read_text(scratch / "b.vtu"));
}

TEST(Vtu, UnwritableDirectoryIsNamed) {
  const Scratch scratch;
  const auto path = scratch / "nowhere/a.vtu";
  EXPECT_EQ(error_of([&] { GridEncoder(points_with_values(1), true).write(path); }),
            "cannot write " + path.string() + ": No such file or directory");
}

}  // namespace
}  // namespace geist::output
