// How displacements and rotations are measured.
#pragma once

namespace geist {

/// small: strains and bonds linear in displacement and rotation, directions frozen; finite: the same laws in
/// axes that turn with every element and every particle, indifferent to the frame.
enum class Kinematics { small, finite };

}  // namespace geist
