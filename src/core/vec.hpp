// Small vectors and matrices of doubles for set-up code, laws and probes.
#pragma once
#include <array>
#include <cmath>
#include <cstddef>

namespace geist {

/// A vector of three components.
struct Vec3 {
  double x = 0, y = 0, z = 0;
  constexpr double& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr double operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3& operator+=(Vec3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(Vec3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
  friend constexpr Vec3 operator+(Vec3 a, Vec3 b) { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, Vec3 b) { return a -= b; }
  friend constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
  friend constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
  friend constexpr bool operator==(Vec3, Vec3) = default;
};

constexpr double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(Vec3 a) { return std::sqrt(dot(a, a)); }

/// A 3 × 3 matrix, row by row.
struct Mat3 {
  std::array<Vec3, 3> row;
  constexpr Vec3& operator[](std::size_t i) { return row[i]; }
  constexpr Vec3 operator[](std::size_t i) const { return row[i]; }
  friend constexpr Vec3 operator*(const Mat3& a, Vec3 b) {
    return {dot(a.row[0], b), dot(a.row[1], b), dot(a.row[2], b)};
  }
};

constexpr double det(const Mat3& a) { return dot(a[0], cross(a[1], a[2])); }

/// Inverse of a matrix; the caller has checked that det(a) ≠ 0.
constexpr Mat3 inverse(const Mat3& a) {
  const Vec3 c0 = cross(a[1], a[2]), c1 = cross(a[2], a[0]), c2 = cross(a[0], a[1]);
  const double s = 1 / dot(a[0], c0);
  return {{Vec3{s * c0.x, s * c1.x, s * c2.x}, Vec3{s * c0.y, s * c1.y, s * c2.y},
           Vec3{s * c0.z, s * c1.z, s * c2.z}}};
}

}  // namespace geist
