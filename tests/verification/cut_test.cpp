// What the lattice leaves of the hexahedra: volumes, masses, and gradients that stay exact.
#include "coupling/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "case/build.hpp"
#include "case/read.hpp"
#include "geometry/hex8.hpp"
#include "verification/bodies.hpp"

namespace geist::verification {
namespace {

Model consistent(const std::string& text, std::vector<std::string> set = {}) {
  set.push_back("method=consistent");
  return std::move(build(read_case_text(text, "cut.toml", set)).simulation.model);
}

double total_mass(const Model& model) {
  double sum = 0;
  for (const double m : model.mesh.mass) sum += m;
  return sum;
}

double taken(const Mesh& mesh) {
  double volume = 0;
  for (const HexCut& cut : mesh.cuts)
    volume += hex8::volume(hex8::corners(mesh, static_cast<std::size_t>(cut.element))) - cut.volume;
  return volume;
}

/// Octants in [1 − r, 1] beside the lattice's two faces and in the corner between them, at z from 0 to 1.
TEST(Cut, TakesWhatTheCellsFill) {
  const double r = 0.125;
  const Model model = consistent(box_in_an_L);
  EXPECT_NEAR(taken(model.mesh), 2 * r + r * r, 1e-12);
}

TEST(Cut, KeepsMass) {
  for (const char* text : {box_in_an_L, L_around_a_box}) {
    const Model cut = consistent(text);
    const Model whole =
        std::move(build(read_case_text(text, "cut.toml", {"method=published"})).simulation.model);
    EXPECT_NEAR(total_mass(cut), total_mass(whole), 1e-13 * total_mass(whole));
    EXPECT_GT(*std::min_element(cut.mesh.mass.begin(), cut.mesh.mass.end()), 0);
  }
}

/// Σ G_a = 0 and Σ x_a ⊗ G_a = V 1: constants and linear fields, with the corrections at corners too.
TEST(Cut, LeavesGradientsOfLinearFieldsExact) {
  for (const char* text : {box_in_an_L, L_around_a_box}) {
    const Model model = consistent(text);
    ASSERT_FALSE(model.mesh.cuts.empty());
    for (const HexCut& cut : model.mesh.cuts) {
      const auto x = hex8::corners(model.mesh, static_cast<std::size_t>(cut.element));
      const double V = hex8::volume(x), area = std::cbrt(V * V);
      Vec3 sum;
      Mat3 first{};
      for (int a = 0; a < 8; ++a) {
        sum += cut.gradient[a];
        for (int i = 0; i < 3; ++i) first[i] += (x[a] - x[0])[i] * cut.gradient[a];
      }
      EXPECT_LT(norm(sum), 1e-12 * area);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(first[i][j], i == j ? cut.volume : 0, 1e-11 * V);
    }
  }
}

/// Of the first layer of thin elements 10⁻⁶ is left, and it has mass.
TEST(Cut, KeepsWhatIsSwallowedAttached) {
  const Model model =
      consistent(box_in_an_L, {"regions.foot.divisions=[16,8,2]", "regions.wall.divisions=[8,8,2]"});
  double least = 1;
  for (const HexCut& cut : model.mesh.cuts)
    least = std::min(
        least, cut.volume / hex8::volume(hex8::corners(model.mesh, static_cast<std::size_t>(cut.element))));
  EXPECT_NEAR(least, 1e-6, 1e-9);
  for (const double m : model.mesh.mass) EXPECT_GT(m, 0);
}

}  // namespace
}  // namespace geist::verification
