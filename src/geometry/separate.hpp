// Separating regions of hexahedra that share nodes.
#pragma once
#include "model/mesh.hpp"

namespace geist {

/// Give region b nodes of its own wherever it shares some with region a: both stay where they are and are
/// tied no more. The new nodes come after all others. To be called before finish(mesh).
void separate(Mesh& mesh, const HexRegion& a, const HexRegion& b);

}  // namespace geist
