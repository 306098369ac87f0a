// Units: from the case's units of length, mass and time to the names of all others.
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace geist::output {

/// A quantity as powers of length, mass, time and angle (radians).
struct Dimension {
  int length = 0, mass = 0, time = 0, angle = 0;
  friend constexpr bool operator==(Dimension, Dimension) = default;
};

namespace dimension {
inline constexpr Dimension none{}, length{1}, mass{0, 1}, time{0, 0, 1}, angle{0, 0, 0, 1};
inline constexpr Dimension velocity{1, 0, -1}, spin{0, 0, -1, 1}, frequency{0, 0, -1}, density{-3, 1, 0};
inline constexpr Dimension force{1, 1, -2}, stress{-1, 1, -2}, energy{2, 1, -2};
inline constexpr Dimension momentum{1, 1, -1}, angular_momentum{2, 1, -1};
}  // namespace dimension

/// A unit's name, and the power of ten that makes it metres, kilograms or seconds.
struct UnitName {
  std::string_view name;
  int power;
};
inline constexpr std::array lengths{UnitName{"m", 0}, UnitName{"cm", -2}, UnitName{"mm", -3},
                                    UnitName{"um", -6}};
inline constexpr std::array masses{UnitName{"t", 3}, UnitName{"kg", 0}, UnitName{"g", -3},
                                   UnitName{"mg", -6}};
inline constexpr std::array times{UnitName{"s", 0}, UnitName{"ms", -3}, UnitName{"us", -6}};

/// The units of a case.
class UnitSystem {
 public:
  /// Names as in the lists above; throws std::invalid_argument for others.
  UnitSystem(std::string_view length, std::string_view mass, std::string_view time);

  const UnitName& length() const { return length_; }
  const UnitName& mass() const { return mass_; }
  const UnitName& time() const { return time_; }
  /// Name of the unit that a quantity is counted in: N, Pa or J with an SI prefix where that fits ("MPa"),
  /// otherwise a product of the three units ("g*mm/ms^2"); "1" for a pure number.
  std::string label(Dimension d) const;

 private:
  UnitName length_, mass_, time_;
};

}  // namespace geist::output
