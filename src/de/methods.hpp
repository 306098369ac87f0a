// The two kinds of lattices as the kernels see them: what their bonds are, and how they move.
#pragma once
#include <cstddef>
#include <cstdint>

#include "de/finite_stencil.hpp"
#include "de/stencil.hpp"

namespace geist::de {

/// The bonds of published lattices: the same everywhere.
struct Published {
  ElasticBond inner;

  explicit Published(const Lattice& lattice) : inner(ElasticBond::from(lattice.material, lattice.radius())) {}
  template <class T = Pack>
  GEIST_INLINE const ElasticBond& at(std::size_t) const {
    return inner;
  }
  /// visit(law) with the bonds of eight sites.
  template <class Visit>
  GEIST_INLINE void visit(std::size_t, Visit visit_law) const {
    visit_law(inner);
  }
};

/// The bonds of consistent lattices: those of the endless lattice, or by the sites' classes.
struct Consistent {
  static constexpr std::uint32_t none = ~0u;
  EndlessBond inner;
  const BondClass* classes;
  const std::uint32_t *class_of, *word;

  explicit Consistent(const Lattice& lattice)
      : inner(EndlessBond::from(lattice.material, lattice.radius())),
        classes(lattice.classes.data()),
        class_of(lattice.class_of.data()),
        word(lattice.word.data()) {}
  template <class T = Pack>
  GEIST_INLINE ClassBonds<T> at(std::size_t s) const {
    return {inner, classes, class_of + s};
  }
  /// Most packs have one class, at ends of rows two: those of their first and last sites.
  template <class Visit>
  GEIST_INLINE void visit(std::size_t s, Visit visit_law) const {
    std::uint32_t first = none, last = none;
    bool others = false;
    for (std::size_t l = s; l < s + lanes; ++l)
      if (word[l]) last = class_of[l], first = first == none ? last : first;
    for (std::size_t l = s; l < s + lanes; ++l)
      others |= word[l] != 0 && class_of[l] != first && class_of[l] != last;
    if (others)
      visit_law(at(s));
    else if (first == last)
      visit_law(ClassBonds<double>(inner, classes, &first));
    else
      visit_law(TwoClassBonds{inner, classes + first, classes + last, load(class_of + s) == last});
  }
};

/// f(method, view) with those of the lattice.
template <class F>
auto with_kinematics(const Lattice& lattice, F f) {
  const auto with_view = [&](const auto& method) {
    return lattice.kinematics == Kinematics::finite ? f(method, finite_view(lattice))
                                                    : f(method, view(lattice.motion));
  };
  return lattice.consistent() ? with_view(Consistent(lattice)) : with_view(Published(lattice));
}

}  // namespace geist::de
