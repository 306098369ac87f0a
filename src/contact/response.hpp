// Response: the force of one contact from its overlap, its motion, and what it remembers.
#pragma once
#include "contact/law.hpp"
#include "core/vec.hpp"

namespace geist::contact {

/// A law with the constants of a pair of materials.
struct PairLaw {
  Law law;
  PairModuli moduli;
  double damping = 0;  ///< ζ

  PairLaw(const Law& law, const Material& a, const Material& b);
};

/// What a contact carries from step to step; all zero where nothing touches.
struct Memory {
  Vec3 tangent;            ///< friction force on the contactor
  double stiffness = 0;    ///< tangential, of the last step
  Vec3 sliding;            ///< in the last step, length
  double damping = 0;      ///< normal force of damping in the last step
  double normal_rate = 0;  ///< δ̇ of the last step
  bool touching = false;
};

/// A contact at one instant.
struct Meeting {
  NormalStiffness spring;
  double overlap;       ///< δ
  double pressing;      ///< Σ of the normal forces' magnitudes / |their sum|; more than 1 in a groove
  Vec3 normal;          ///< unit, from the other to the contactor
  Vec3 velocity;        ///< of the contactor relative to the other, at the contact
  double inverse_mass;  ///< 1/m*; 0 if neither can move
};

/// Force on the contactor, and what became of the energy.
struct Response {
  double normal = 0;  ///< ≥ 0, along the normal
  Vec3 tangent;
  double stored = 0;                 ///< now, in both springs
  double friction = 0, damping = 0;  ///< dissipated in the last step
};

/// Force at the end of a step of length dt, in which the motion was meeting.velocity.
Response respond(const PairLaw& law, const Meeting& meeting, double dt, Memory& memory);

/// A contact that touches no more: what its springs held is lost. Its last forces act for half a step more,
/// on a motion taken to be that of the last step.
Response release(double dt, Memory& memory);

}  // namespace geist::contact
