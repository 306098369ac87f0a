#include "geometry/separate.hpp"

namespace geist {

void separate(Mesh& mesh, const HexRegion& a, const HexRegion& b) {
  std::vector<bool> of_a(mesh.points.size(), false);
  for (std::size_t e = a.first; e < a.first + a.count; ++e)
    for (const std::int32_t node : mesh.elements[e]) of_a[node] = true;
  std::vector<std::int32_t> own(mesh.points.size(), -1);
  for (std::size_t e = b.first; e < b.first + b.count; ++e)
    for (std::int32_t& node : mesh.elements[e]) {
      if (!of_a[node]) continue;
      std::int32_t& twin = own[node];
      if (twin < 0) {
        twin = static_cast<std::int32_t>(mesh.points.size());
        mesh.points.push_back(mesh.points[node]);
      }
      node = twin;
    }
}

}  // namespace geist
