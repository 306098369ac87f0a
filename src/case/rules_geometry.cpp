// Rules of a lattice's geometry that need no mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "case/rules.hpp"
#include "geometry/packing.hpp"

namespace geist {

namespace {

constexpr double most_radii_tried = 1e4;
constexpr std::array<char, 3> axes{'x', 'y', 'z'};

bool all_whole(const std::vector<double>& lengths, double pitch) {
  return std::all_of(lengths.begin(), lengths.end(), [&](double length) { return is_whole(length, pitch); });
}

/// Every length that must be a whole number of pitches: the boxes' edges and their offsets from the first
/// one.
std::vector<double> lengths_of(const std::vector<Box>& boxes) {
  std::vector<double> lengths;
  for (const Box& box : boxes) {
    for (std::size_t a = 0; a < 3; ++a) {
      lengths.push_back(box.high[a] - box.low[a]);
      if (box.low[a] != boxes[0].low[a]) lengths.push_back(std::abs(box.low[a] - boxes[0].low[a]));
    }
  }
  return lengths;
}

/// The radius written with as few digits as still fit.
std::string short_radius(double radius, const std::vector<double>& lengths) {
  for (int digits = 3; digits < 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", radius, digits);
    if (all_whole(lengths, 2 * std::stod(text))) return text;
  }
  return fmt::format("{}", radius);
}

/// "; radii that fit: 0.2 or 0.214286", the nearest ones below and above; empty if there are none.
std::string radii_that_fit(const std::vector<double>& lengths, double radius) {
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  const double number = shortest / (2 * radius);
  std::vector<std::string> found;
  const auto look = [&](double first, double direction) {
    for (double n = first, tried = 0; n >= 1 && tried < most_radii_tried; n += direction, ++tried)
      if (all_whole(lengths, shortest / n)) {
        found.push_back(short_radius(shortest / (2 * n), lengths));
        return;
      }
  };
  look(std::max(1.0, std::ceil(number)), 1);
  look(std::floor(number), -1);
  return found.empty() ? "" : fmt::format("; radii that fit: {}", join(found, "or"));
}

/// One lattice, its boxes and its grid.
struct Packing {
  std::vector<Box> boxes;
  double radius;
  std::string_view key;  ///< that the boxes come from
};

/// Boxes are to blame if they have been changed and the radius has not, otherwise the radius.
toml::source_region place_of(const View& region, const Packing& packing) {
  const bool boxes = region.set(packing.key) && !region.set("radius");
  return region.place(boxes ? packing.key : "radius");
}

bool check_edges(Document& document, const View& region, const Packing& packing) {
  for (const Box& box : packing.boxes) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double length = box.high[a] - box.low[a], pitch = 2 * packing.radius;
      if (is_whole(length, pitch) && std::round(length / pitch) >= 1) continue;
      document.report(
          place_of(region, packing),
          fmt::format("the edge along {} of '{}', {:.10g} long, is not a whole number of diameters {:.10g}{}",
                      axes[a], packing.key, length, pitch,
                      radii_that_fit(lengths_of(packing.boxes), packing.radius)));
      return false;
    }
  }
  return true;
}

bool check_offsets(Document& document, const View& region, const Packing& packing) {
  const Box& first = packing.boxes[0];
  for (std::size_t b = 1; b < packing.boxes.size(); ++b) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double offset = packing.boxes[b].low[a] - first.low[a], pitch = 2 * packing.radius;
      if (is_whole(offset, pitch)) continue;
      document.report(region.place(packing.key),
                      fmt::format("box {} is not on the grid of the first one: it lies {:.10g} further along "
                                  "{}, which is not a whole number of diameters {:.10g}",
                                  b + 1, offset, axes[a], pitch));
      return false;
    }
  }
  return true;
}

void check_number(Document& document, const View& region, const Packing& packing) {
  double number = 1;
  for (std::size_t a = 0; a < 3; ++a) {
    double low = packing.boxes[0].low[a], high = packing.boxes[0].high[a];
    for (const Box& box : packing.boxes) low = std::min(low, box.low[a]), high = std::max(high, box.high[a]);
    number *= (high - low) / (2 * packing.radius);
  }
  if (!(number <= most_places_in_region))
    document.report(place_of(region, packing),
                    fmt::format("about {:.2g} particles; a region may have {:.0e} at most", number,
                                most_places_in_region));
}

}  // namespace

void check_lattice(Document& document, const View& region) {
  for (const View& cut : region.tables("minus")) check_length(document, cut.table("cylinder"));
  const auto box = region.get<Box>("box");
  const auto boxes = region.get<std::vector<Box>>("boxes");
  const auto radius = region.get<double>("radius");
  if (!radius || box.has_value() == boxes.has_value()) return;
  const Packing packing{box ? std::vector<Box>{*box} : *boxes, *radius, box ? "box" : "boxes"};
  const std::size_t before = document.problems.size();
  check_number(document, region, packing);
  if (document.problems.size() > before) return;
  if (check_edges(document, region, packing)) check_offsets(document, region, packing);
}

void check_length(Document& document, const std::optional<View>& cylinder) {
  const auto from = cylinder ? cylinder->get<Vec3>("from") : std::nullopt;
  if (from && from == cylinder->get<Vec3>("to"))
    document.report(cylinder->place("to"), "the cylinder has no length: 'from' and 'to' are the same point");
}

}  // namespace geist
