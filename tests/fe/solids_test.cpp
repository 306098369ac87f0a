// Balls and cylinders as elastic bodies: mass, rigid motion without energy, uniform strain with the right
// one.
#include <gtest/gtest.h>

#include <numeric>

#include "geometry/block.hpp"
#include "support.hpp"

namespace geist::fe {
namespace {

using namespace testing;

const Material material{"m", 2.3, 10, 0.3};

Mesh mesh_with(const Body& body, const std::string& formulation) {
  HexRegion region;
  region.material = material, region.formulation = formulation, region.hourglass_coefficient = 0.05;
  const Grading middle{Towards::middle, 3}, high{Towards::high, 3};
  Mesh mesh;
  append(mesh, region, mesh_of(body, {{middle, middle, high}, high}));
  finish(mesh);
  lump_masses(mesh);
  return mesh;
}

std::vector<Mesh> round_bodies() {
  std::vector<Mesh> all;
  for (const char* formulation : {"full", "selective-reduced", "assumed-strain", "one-point"}) {
    all.push_back(mesh_with(BallBody{{{0.1, 0.2, 0.3}, 1}, 6, 3}, formulation));
    all.push_back(mesh_with(CylinderBody{{{1, 0, 0}, {0, 0, 2}, 1}, 6, 3, 4}, formulation));
  }
  return all;
}

double volume_of(const Mesh& mesh) {
  double v = 0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) v += hex8::volume(hex8::corners(mesh, e));
  return v;
}

void move(Mesh& mesh, const Mat3& gradient) {
  for (std::size_t n = 0; n < mesh.nodes(); ++n) mesh.u.set(n, gradient * mesh.points[n] + Vec3{1, 2, 3});
}

TEST(RoundBodies, HaveTheMassOfTheirVolume) {
  for (const Mesh& mesh : round_bodies()) {
    const double mass = std::accumulate(mesh.mass.begin(), mesh.mass.end(), 0.0);
    EXPECT_NEAR(mass / (2.3 * volume_of(mesh)), 1, 1e-13);
    for (const double m : mesh.mass) EXPECT_GT(m, 0);
  }
}

TEST(RoundBodies, MoveRigidlyWithoutEnergy) {
  const Mat3 spin{{Vec3{0, -0.3, 0.5}, Vec3{0.3, 0, -0.7}, Vec3{-0.5, 0.7, 0}}};
  for (Mesh& mesh : round_bodies()) {
    move(mesh, spin);
    const Energies found = energies(mesh);
    EXPECT_NEAR(found.strain, 0, 1e-26);
    EXPECT_NEAR(found.hourglass, 0, 1e-26);
    internal_forces(mesh);
    for (std::size_t p = 0; p < mesh.nodes(); ++p) EXPECT_LT(norm(mesh.f.vector(p)), 1e-13);
  }
}

TEST(RoundBodies, HoldUniformStrain) {
  const Mat3 gradient{{Vec3{0.1, 0.4, -0.2}, Vec3{0.3, -0.5, 0.6}, Vec3{0.2, 0.1, 0.7}}};
  const Mat3 s = stress(gradient, material.lambda(), material.mu());
  double density = 0;
  for (int i = 0; i < 3; ++i) density += dot(s[i], gradient[i]) / 2;
  for (Mesh& mesh : round_bodies()) {
    move(mesh, gradient);
    const Energies found = energies(mesh);
    EXPECT_NEAR(found.strain / (density * volume_of(mesh)), 1, 1e-12);
    EXPECT_NEAR(found.hourglass, 0, 1e-24);
  }
}

}  // namespace
}  // namespace geist::fe
