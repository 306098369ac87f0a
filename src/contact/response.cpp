#include "contact/response.hpp"

#include <algorithm>
#include <cmath>

namespace geist::contact {
namespace {

double square(Vec3 a) { return dot(a, a); }

/// A tangential force turned into the plane of the new normal, with its length kept.
Vec3 turned(Vec3 tangent, Vec3 normal) {
  const Vec3 flat = tangent - dot(tangent, normal) * normal;
  const double length = norm(flat);
  return length > 0 ? (norm(tangent) / length) * flat : Vec3{};
}

/// The friction force, by increments (Mindlin and Deresiewicz 1953 in the simplified form of Thornton,
/// Cummins and Cleary 2013): −k_t Δs; where k_t has fallen with the normal force, what was there falls with
/// it; then Coulomb's limit. Work is reckoned by the trapezoidal rule, as central differences conserve it;
/// `friction` is what of it the springs do not hold.
void slide(const Meeting& meeting, double k, double limit, double dt, Memory& memory, Response& response) {
  const Vec3 sliding = dt * (meeting.velocity - dot(meeting.velocity, meeting.normal) * meeting.normal);
  const Vec3 last = turned(memory.tangent, meeting.normal);
  const bool falls = k < memory.stiffness;
  const Vec3 before = falls ? (k / memory.stiffness) * last : last;
  Vec3 after = before - k * sliding;
  const double size = norm(after);
  if (size > limit) after *= limit / size;
  const Vec3 slip = sliding - (1 / k) * (before - after);
  response.friction = -0.5 * (dot(before + after, slip) + dot(last - before, sliding));
  if (memory.stiffness > 0)
    response.friction += square(last) / (2 * memory.stiffness) - square(before) / (2 * k);
  response.tangent = memory.tangent = after;
  memory.stiffness = k, memory.sliding = sliding;
  response.stored += square(after) / (2 * k);
}

}  // namespace

PairLaw::PairLaw(const Law& l, const Material& a, const Material& b)
    : law(l), moduli(a, b), damping(damping_ratio(l.normal, l.restitution)) {}

Response respond(const PairLaw& pair, const Meeting& meeting, double dt, Memory& memory) {
  Response response;
  const double elastic = meeting.spring.force(meeting.overlap), k = meeting.spring.tangent(meeting.overlap);
  const double rate = -dot(meeting.velocity, meeting.normal);  // δ̇
  const double dashpot =
      meeting.inverse_mass > 0 ? 2 * pair.damping * std::sqrt(k / meeting.inverse_mass) : 0;
  // The rate is that of half a step ago; the one of now is ½ Δt F/m* less, as far as this contact goes.
  const double lag = 1 + 0.5 * dt * dashpot * meeting.inverse_mass;
  response.normal = std::max(0.0, (elastic + dashpot * rate) / lag);
  response.stored = meeting.spring.energy(meeting.overlap);
  const double damping = response.normal - elastic;
  response.damping = 0.5 * dt * (memory.damping + damping) * rate;
  memory.damping = damping, memory.normal_rate = rate, memory.touching = true;
  if (pair.law.friction > 0)
    slide(meeting, pair.moduli.tangential_ratio() * k, pair.law.friction * response.normal * meeting.pressing,
          dt, memory, response);
  return response;
}

Response release(double dt, Memory& memory) {
  Response response;
  if (!memory.touching) return response;
  response.damping = 0.5 * dt * memory.damping * memory.normal_rate;
  if (memory.stiffness > 0)
    response.friction =
        square(memory.tangent) / (2 * memory.stiffness) - 0.5 * dot(memory.tangent, memory.sliding);
  memory = {};
  return response;
}

}  // namespace geist::contact
