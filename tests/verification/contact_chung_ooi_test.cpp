// The eight benchmark impacts of Y. C. Chung and J. Y. Ooi (Granular Matter 13 (2011) 643–656): single
// particles, on each other and on a rigid plane. Sizes, speeds and materials are those that open
// re-implementations agree on (KratosMultiphysics, applications/DEMApplication, DEM_benchmarks_class.py;
// YADE, merge request 933; pysph, examples/dem/discontinuous_dem). What is asserted are closed forms (Hertz;
// gross sliding, which needs impulses only) and, where the contact sticks, the law itself integrated here on
// a line.
//
// A particle weighs as much as its cell, so densities are given times π/6. A lattice's Poisson's ratio is at
// most 1/4, but a contact knows E* and G* only: where the benchmark's ratio is larger, sphere and plane share
// the compliance such that both are what they should be. A plane is a block that is held; it moves not at
// all, and its stiffness is no bound of the time step.
//
// The lever of friction is R − δ, as the point of contact is where the surfaces are; the references have R.
// So closed forms with a spin are met to δ/R, which is 3e-2 for polyethylene and below 7e-3 for all others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "verification/contact_support.hpp"

namespace geist::verification {
namespace {

using std::numbers::pi;

struct Ball {
  double radius, density, young, poisson;
  double mass() const { return 4.0 / 3 * pi * std::pow(radius, 3) * density; }
};

/// What a contact sees of two elastic bodies: 1/E* and G*/E*.
struct Pair {
  double E, kappa;  ///< E*; k_t/k_n = 4 G*/E*
};
Pair on_rigid_plane(const Ball& b) {
  return {b.young / (1 - b.poisson * b.poisson), 2 * (1 - b.poisson) / (2 - b.poisson)};
}

/// Hertz' impact: 0.5 m v² = 0.4 k δ^{5/2}, k = 4/3 E* √R*.
struct Hertz {
  double mass, radius, modulus, speed;  ///< m*, R*, E*
  double stiffness() const { return 4.0 / 3 * modulus * std::sqrt(radius); }
  double indentation() const { return std::pow(1.25 * mass * speed * speed / stiffness(), 0.4); }
  double force() const { return stiffness() * std::pow(indentation(), 1.5); }
  double duration() const {
    return 2 * std::sqrt(pi) * std::tgamma(1.4) / std::tgamma(0.9) * indentation() / speed;
  }
};
Hertz hertz_on_plane(const Ball& b, double speed) { return {b.mass(), b.radius, on_rigid_plane(b).E, speed}; }

/// Share of the compliance that a plane with ν = 0.45 must have so that a sphere with ν = 0.2 on it has the
/// k_t/k_n of a sphere with ν on a rigid plane: 4 G*/E* = 8 / Σ (share · r), r = 4 (2 − ν)/(1 − ν).
double plane_share(double poisson) {
  const auto r = [](double nu) { return (2 - nu) / (1 - nu); };
  return poisson <= 0.25 ? 0 : (r(poisson) - r(0.2)) / (r(0.45) - r(0.2));
}

std::string material(const std::string& name, double density, double young, double poisson) {
  return fmt::format("[materials.{}]\ndensity = {}\nyoung = {}\npoisson = {}\n", name, density, young,
                     poisson);
}

/// A particle whose lowest point is at z.
std::string particle(const std::string& name, const Ball& b, double z) {
  return fmt::format(
      "[regions.{0}]\ntype = \"lattice\"\nmaterial = \"{0}\"\nbox = [[-{1}, -{1}, {2}], [{1}, {1}, {3}]]\n"
      "radius = {1}\n",
      name, b.radius, z, z + 2 * b.radius);
}

std::string moving(const std::string& region, Vec3 v, Vec3 spin = {}, double z = 0) {
  return fmt::format("[[initial]]\nwhere = {{ region = \"{}\" }}\nvelocity = [{}, {}, {}]\n", region, v.x,
                     v.y, v.z) +
         (norm(spin) > 0 ? fmt::format("spin = [{}, {}, {}]\nabout = [0, 0, {}]\n", spin.x, spin.y, spin.z, z)
                         : "");
}

std::string the_rest(const std::string& a, const std::string& b, double friction, double restitution,
                     double duration, double time_step) {
  return fmt::format(
      "[coupling]\ntype = \"none\"\n[[contact]]\nbetween = [\"{}\", \"{}\"]\nlaw = \"hertz\"\n"
      "friction = {}\nrestitution = {}\n[analysis]\ntype = \"dynamic\"\nduration = {}\ntime_step = {}\n"
      "[probes.force]\nwhere = {{ region = \"{}\" }}\nquantity = \"contact-force\"\ncomponent = \"z\"\n",
      a, b, friction, restitution, duration, time_step, a);
}

const std::string si = "units = { length = \"m\", mass = \"kg\", time = \"s\" }\n";
constexpr int steps_per_impact = 2000;

/// How far things are apart at first, in radii: less than a thousandth of any indentation.
constexpr double gap = 1e-7;

/// A slow contact with restitution takes longer than Hertz' time, by a half for the lowest here.
double long_enough(const Hertz& hertz, double restitution) {
  return (restitution < 1 ? 2.5 : 1.3) * hertz.duration();
}

struct Bounce {
  Particle before, after;
  Recording recording;
};

/// A sphere falls on a rigid plane with speed v_n, tangential velocity v_t along x, and spin about y.
Bounce bounce(const Ball& b, double v_n, double v_t, double spin, double friction, double restitution) {
  const double share = plane_share(b.poisson), nu = share > 0 ? 0.2 : b.poisson, R = b.radius;
  const Pair pair = on_rigid_plane(b);
  const double young = pair.E * (1 - nu * nu) / (1 - share);
  const double plane = share > 0 ? pair.E * (1 - 0.45 * 0.45) / share : 1e12 * b.young;
  const Hertz hertz = hertz_on_plane(b, v_n);
  const std::string text =
      si + material("ball", b.density * pi / 6, young, nu) + material("plane", b.density, plane, 0.45) +
      particle("ball", b, gap * R) +
      fmt::format(
          "[regions.plane]\ntype = \"hexahedra\"\nmaterial = \"plane\"\nbox = [[-{0}, -{0}, -{0}], [{0}, "
          "{0}, "
          "0]]\ndivisions = [1, 1, 1]\n[[supports]]\nwhere = {{ region = \"plane\" }}\nfix = [\"x\", \"y\", "
          "\"z\"]\n",
          4 * R) +
      moving("ball", {v_t, 0, -v_n}, {0, spin, 0}, R * (1 + gap)) +
      the_rest("ball", "plane", friction, restitution, long_enough(hertz, restitution),
               hertz.duration() / steps_per_impact);
  Recording r = run_text(text, long_enough(hertz, restitution) / 1000);
  const Particle after = only_particle(r.model());
  Particle before = after;
  before.v = {v_t, 0, -v_n}, before.spin = {0, spin, 0};
  EXPECT_NEAR(after.mass / b.mass(), 1, 1e-12);
  EXPECT_EQ(r.probe[0].back(), 0) << "still in contact";
  EXPECT_TRUE(r.warnings.empty());
  // Forces are summed by the trapezoidal rule, the ledger's kinetic energy is that of central differences: (ω
  // Δt)²/8 of the energy, ω ≈ π/T: 3e-7; friction and damping are functions of the velocity half a step
  // before, π/2000 of themselves.
  EXPECT_LT(r.worst_balance(), restitution < 1 || friction > 0 ? 2e-3 : 1e-6);
  return {before, after, std::move(r)};
}

// --- 1 to 3: along the normal ---

/// Central differences with 2000 steps in T: (π/2000)²/24 = 1e-7 in time, and as much in the rest. The record
/// of the force has a row every 1.3 T/1000, and Hertz' peak is flat: 1e-5.
constexpr double of_hertz = 1e-4;

struct Spheres {
  const char* name;
  Ball ball;
};

TEST(ChungOoi, Test1TwoEqualSpheres) {
  for (const auto& [name, b] :
       {Spheres{"glass", {0.01, 2800, 4.8e10, 0.2}}, Spheres{"limestone", {0.01, 2500, 2e10, 0.25}}}) {
    SCOPED_TRACE(name);
    const Hertz hertz{b.mass() / 2, b.radius / 2, on_rigid_plane(b).E / 2, 20};
    const Recording r = run_text(
        si + material("low", b.density * pi / 6, b.young, b.poisson) +
        material("high", b.density * pi / 6, b.young, b.poisson) + particle("low", b, -2 * b.radius) +
        particle("high", b, gap * b.radius) + moving("low", {0, 0, 10}) + moving("high", {0, 0, -10}) +
        the_rest("high", "low", 0.35, 1, 1.3 * hertz.duration(), hertz.duration() / steps_per_impact));
    EXPECT_NEAR(peak(r.probe[0]) / hertz.force(), 1, of_hertz);
    EXPECT_NEAR(only_particle(r.model(), 0).v.z / -10, 1, of_hertz);
    EXPECT_NEAR(only_particle(r.model(), 1).v.z / 10, 1, of_hertz);
    EXPECT_LT(r.worst_momentum(), 1e-12 * b.mass() * 10);
    EXPECT_LT(r.worst_balance(), 1e-6);
    RecordProperty(name, fmt::format("{:.6g} N, Hertz {:.6g} N", peak(r.probe[0]), hertz.force()));
  }
}

/// Row of the first and of the last force: the duration, to one row at either end.
double duration_of(const Recording& r) {
  double first = 0, last = 0;
  for (std::size_t i = 0; i < r.time.size(); ++i)
    if (r.probe[0][i] > 0) first = first > 0 ? first : r.time[i], last = r.time[i];
  return last - first;
}

TEST(ChungOoi, Test2RigidPlane) {
  for (const auto& [name, b] :
       {Spheres{"aluminium", {0.1, 2699, 7e10, 0.3}}, Spheres{"magnesium", {0.1, 1800, 4e10, 0.35}}}) {
    SCOPED_TRACE(name);
    const Hertz hertz = hertz_on_plane(b, 0.2);
    const Bounce bounced = bounce(b, 0.2, 0, 0, 0, 1);
    EXPECT_NEAR(peak(bounced.recording.probe[0]) / hertz.force(), 1, of_hertz);
    EXPECT_NEAR(duration_of(bounced.recording) / hertz.duration(), 1, 3e-3);
    EXPECT_NEAR(bounced.after.v.z / 0.2, 1, of_hertz);
    RecordProperty(name,
                   fmt::format("{:.6g} N, Hertz {:.6g} N", peak(bounced.recording.probe[0]), hertz.force()));
  }
}

/// Forces never pull, and ζ is made for that: see damping_ratio. The first and the last step of a contact are
/// cut somewhere, with a thousandth of the impulse at most, and little of that is lost.
TEST(ChungOoi, Test3Restitution) {
  for (const auto& [name, b] : {Spheres{"aluminium oxide", {0.0025, 4000, 3.8e11, 0.23}},
                                Spheres{"cast iron", {0.0025, 7000, 1e11, 0.25}}})
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      const Bounce bounced = bounce(b, 3.9, 0, 0, 0, e);
      EXPECT_NEAR(bounced.after.v.z / 3.9 / e, 1, 5e-4) << name << " " << e;
      RecordProperty(fmt::format("{} {}", name, e), fmt::format("{:.5f}", bounced.after.v.z / 3.9));
    }
}

// --- 4 to 6: oblique, on a plane ---

/// The law on a line, written anew: Hertz' force and its damping, Mindlin's spring that is rescaled when the
/// normal force falls, Coulomb's limit. v: tangential, of the centre; w: the spin times R, so that the point
/// of contact slides with v + w (1 − δ/R).
struct Line {
  double v, w;
};
Line on_a_line(const Ball& b, double v_n, Line now, double friction, double restitution) {
  const Hertz hertz = hertz_on_plane(b, v_n);
  const double m = b.mass(), dt = hertz.duration() / 50000, kappa = on_rigid_plane(b).kappa;
  const double damping = 2 * contact::damping_ratio(contact::Law::Normal::hertz, restitution);
  double z = dt * v_n, vz = v_n, tangent = 0, k_before = 0;
  for (; z > 0; z += dt * vz) {
    const double k_n = 1.5 * hertz.stiffness() * std::sqrt(z), k = kappa * k_n;
    const double force = std::max(0.0, k_n * z / 1.5 + damping * std::sqrt(m * k_n) * vz);
    const double lever = 1 - z / b.radius;
    if (k < k_before) tangent *= k / k_before;
    tangent = std::clamp(tangent - k * dt * (now.v + lever * now.w), -friction * force, friction * force);
    k_before = k;
    vz -= dt * force / m, now.v += dt * tangent / m, now.w += dt * 2.5 * lever * tangent / m;
  }
  return now;
}

/// The spin about y that moves the lowest point along x: v + R w, w = −spin.
Line tangential(const Particle& p) { return {p.v.x, -p.radius * p.spin.y}; }

/// Largest indentation / radius.
double depth(const Ball& b, double v_n) { return hertz_on_plane(b, v_n).indentation() / b.radius; }

/// What friction did to a particle's two velocities is one impulse: I Δw = R J, with R − δ for R. Where parts
/// of it have opposite signs, δ/R of either remains of what is less than both: twice as much is allowed.
void expect_one_impulse(const Ball& b, const Bounce& bounced) {
  const Line before = tangential(bounced.before), after = tangential(bounced.after);
  EXPECT_NEAR(after.w - before.w, 2.5 * (after.v - before.v),
              2 * depth(b, -bounced.before.v.z) * std::abs(after.w - before.w));
}

/// Speed 3.9 m/s at 5° to 85°. From 32.5° on it slides all the time: v_t' = v_t − μ (1 + e) v_n and R w' =
/// 5/2 of that.
TEST(ChungOoi, Test4ConstantSpeed) {
  const double mu = 0.092, e = 0.98;
  for (const auto& [name, b] :
       {Spheres{"oxide", {0.0025, 4000, 3.8e11, 0.23}}, Spheres{"alloy", {0.0025, 2700, 7e10, 0.33}}})
    for (int angle = 5; angle <= 85; angle += 5) {
      SCOPED_TRACE(fmt::format("{} {}", name, angle));
      const double v_n = 3.9 * std::cos(angle * pi / 180), v_t = 3.9 * std::sin(angle * pi / 180);
      const Bounce bounced = bounce(b, v_n, v_t, 0, mu, e);
      expect_one_impulse(b, bounced);
      const Line after = tangential(bounced.after);
      if (v_t / v_n >= 3.5 * mu * (1 + e)) {
        const double change = mu * (1 + e) * v_n;
        EXPECT_NEAR((v_t - after.v) / change, 1, 2e-3);
        EXPECT_NEAR(-after.w / (2.5 * change), 1, 1e-3 + depth(b, v_n));
      } else {
        const Line law = on_a_line(b, v_n, {v_t, 0}, mu, e);
        EXPECT_NEAR(after.v, law.v, 2e-3 * v_t);
        EXPECT_NEAR(after.w, law.w, 2e-3 * v_t);
      }
      RecordProperty(fmt::format("{} {}", name, angle),
                     fmt::format("e_t {:.4f}, w {:.1f}", after.v / v_t, after.w / b.radius));
    }
}

/// 5 m/s along the normal, e = 1. x = 2 v_s/(μ v_n) (1 − ν)/(2 − ν) as in Maw, Barber and Fawcett (1976);
/// from x = 4 χ on, χ = 7 (1 − ν)/(2 (2 − ν)), it slides all the time.
TEST(ChungOoi, Test5ConstantNormalSpeed) {
  const double mu = 0.3, v_n = 5;
  for (const auto& [name, b] :
       {Spheres{"steel", {1e-5, 7850, 2.08e11, 0.3}}, Spheres{"polyethylene", {1e-5, 1400, 1e9, 0.4}}})
    for (const double slope : {0.1, 0.2, 0.4, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.5, 4.0}) {
      SCOPED_TRACE(fmt::format("{} {}", name, slope));
      const Bounce bounced = bounce(b, v_n, slope * v_n, 0, mu, 1);
      expect_one_impulse(b, bounced);
      const Line after = tangential(bounced.after), law = on_a_line(b, v_n, {slope * v_n, 0}, mu, 1);
      EXPECT_NEAR(after.v, law.v, 2e-3 * slope * v_n);
      EXPECT_NEAR(after.w, law.w, 2e-3 * slope * v_n);
      if (slope >= 7 * mu) {
        EXPECT_NEAR((slope * v_n - after.v) / (2 * mu * v_n), 1, 1e-3);
      }
      RecordProperty(fmt::format("{} {}", name, slope),
                     fmt::format("v_s'/(mu v_n) {:.4f}, w {:.4f}", (after.v + after.w) / (mu * v_n),
                                 after.w / (mu * v_n)));
    }
}

/// No tangential velocity but spin. With v_s = R w ≥ 2.1 v_n it slides all the time: v_t = μ (1 + e) v_n; or
/// nearly so: at first the dashpot's force, ∝ δ^{1/4}, is much more than Mindlin's spring, ∝ δ^{3/2} v_s/v_n,
/// can follow. The law on a line says the same; the share of the impulse that is lost by it falls like
/// v_n/v_s (5 % of v_n/v_s here; 6 % are allowed).
TEST(ChungOoi, Test6Spin) {
  const double mu = 0.4, e = 0.5, v_n = 0.2;
  for (const auto& [name, b] :
       {Spheres{"aluminium", {0.1, 2700, 7e10, 0.33}}, Spheres{"nylon", {0.1, 1000, 2.5e9, 0.4}}})
    for (const int angle : {65, 70, 75, 80, 85}) {
      SCOPED_TRACE(fmt::format("{} {}", name, angle));
      const double slip = v_n * std::tan(angle * pi / 180);
      const Bounce bounced = bounce(b, v_n, 0, -slip / b.radius, mu, e);
      expect_one_impulse(b, bounced);
      const Line after = tangential(bounced.after);
      const double lost = 0.06 * v_n / slip;
      EXPECT_NEAR(-after.v / (mu * (1 + e) * v_n), 1, lost);
      EXPECT_NEAR((slip - after.w) / (2.5 * mu * (1 + e) * v_n), 1, lost + depth(b, v_n));
      const Line law = on_a_line(b, v_n, {0, slip}, mu, e);
      EXPECT_NEAR(after.v, law.v, 2e-3 * v_n);
      EXPECT_NEAR(after.w, law.w, 5e-3 * v_n);
      RecordProperty(fmt::format("{} {}", name, angle),
                     fmt::format("beta {:.4f}, exact {:.4f}", -(after.v + after.w) / slip,
                                 3.5 * mu * (1 + e) * v_n / slip - 1));
    }
}

// --- 7 and 8: two spheres with spin ---

/// Opposite spins: the surfaces move together, so nothing tangential happens, to the last digit but few.
TEST(ChungOoi, Test7OppositeSpins) {
  for (const auto& [name, b] :
       {Spheres{"aluminium", {0.1, 2700, 7e10, 0.33}}, Spheres{"copper", {0.1, 8900, 1.2e11, 0.35}}})
    for (const int angle : {5, 45, 85}) {
      SCOPED_TRACE(fmt::format("{} {}", name, angle));
      const double spin = 2 * std::tan(angle * pi / 180);
      const Hertz hertz{b.mass() / 2, b.radius / 2, on_rigid_plane(b).E / 2, 0.4};
      const double young = on_rigid_plane(b).E * (1 - 0.04);
      const Recording r = run_text(
          si + material("low", b.density * pi / 6, young, 0.2) +
          material("high", b.density * pi / 6, young, 0.2) + particle("low", b, -2 * b.radius) +
          particle("high", b, gap * b.radius) + moving("low", {0, 0, 0.2}, {0, spin, 0}, -b.radius) +
          moving("high", {0, 0, -0.2}, {0, -spin, 0}, b.radius * (1 + gap)) +
          the_rest("high", "low", 0.4, 0.5, long_enough(hertz, 0.5), hertz.duration() / steps_per_impact));
      for (const std::size_t l : {0, 1}) {
        const Particle p = only_particle(r.model(), l);
        EXPECT_LT(std::abs(p.v.x), 1e-12);
        EXPECT_NEAR(std::abs(p.spin.y) / spin, 1, 1e-12);
        EXPECT_NEAR(std::abs(p.v.z), 0.1, 2e-4);
      }
    }
}

/// Angular momentum about the origin, and a bound of its parts.
Vec3 angular_momentum(const Particle& p) { return p.mass * cross(p.x, p.v) + p.inertia * p.spin; }

/// A small sphere with spin hits a large one, five times as wide and 125,000 times as heavy: test 6 again.
/// Case A: the large one is 1000 times as stiff; case B: as stiff as the small one.
TEST(ChungOoi, Test8DifferentSpheres) {
  const double mu = 0.4, e = 0.5, v_n = 0.2;
  for (const auto& [name, b] :
       {Spheres{"aluminium", {0.1, 2700, 7e10, 0.33}}, Spheres{"nylon", {0.1, 1000, 2.5e9, 0.4}}})
    for (const double stiffer : {1000.0, 1.0})
      for (const int angle : {65, 75, 85}) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, stiffer, angle));
        const double slip = v_n * std::tan(angle * pi / 180), E = on_rigid_plane(b).E;
        const Ball large{5 * b.radius, 1000 * b.density, stiffer * b.young, b.poisson};
        const double reduced = 1 / (1 / b.mass() + 1 / large.mass());
        const Hertz hertz{reduced, 1 / (1 / b.radius + 1 / large.radius), E * stiffer / (1 + stiffer), v_n};
        const Recording r = run_text(
            si + material("large", large.density * pi / 6, E * stiffer * 0.96, 0.2) +
            material("small", b.density * pi / 6, E * 0.96, 0.2) +
            particle("large", large, -2 * large.radius) + particle("small", b, gap * b.radius) +
            moving("small", {0, 0, -v_n}, {0, -slip / b.radius, 0}, b.radius * (1 + gap)) +
            the_rest("small", "large", mu, e, long_enough(hertz, e), hertz.duration() / steps_per_impact));
        const std::size_t s = r.model().lattices[0].name == "small" ? 0 : 1;
        const Particle small = only_particle(r.model(), s), other = only_particle(r.model(), 1 - s);
        const double J = reduced * (1 + e) * v_n;
        const double lost = 0.06 * v_n / slip;  // as in test 6
        EXPECT_NEAR(tangential(small).v / (-mu * J / b.mass()), 1, lost);
        EXPECT_NEAR((slip - tangential(small).w) / (2.5 * mu * J / b.mass()), 1, lost + depth(b, v_n));
        EXPECT_NEAR(other.v.x / (mu * J / large.mass()), 1, lost);
        EXPECT_NEAR(small.v.z - other.v.z, e * v_n, 2e-3 * v_n);
        // To rounding: m v of the large one is as much as that of the small one, in velocities a 10⁵th.
        EXPECT_LT(r.worst_momentum(), 1e-12 * b.mass() * v_n);
        const double spin = small.inertia * slip / b.radius;
        EXPECT_NEAR((angular_momentum(small) + angular_momentum(other)).y, -spin, 1e-10 * spin);
      }
}

}  // namespace
}  // namespace geist::verification
