// From a document without problems, defaults filled in, to a Case.
#pragma once
#include "case/case.hpp"
#include "case/document.hpp"

namespace geist {

Case extract(const Document& document);

}  // namespace geist
