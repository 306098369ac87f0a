// Figures to compare with: bare kernels of another make, measured on another machine whose limits are known.
#pragma once
#include <optional>

#include "measure.hpp"

namespace geist::bench {

/// Items per second of the bare kernels that do the same work as this row's whole step, scaled to this
/// machine by the time that their flops and bytes would take at the limits of either. None where there is no
/// such figure.
std::optional<double> bare_kernels(const Row& row, const Limits& limits);

}  // namespace geist::bench
