// Tables of published or derived results (data/README.md names their sources).
#pragma once

#include <string>

#include "analysis.hpp"

namespace accuracy {

/// One column over the first, by its name in the file's header. Throws if there is none.
Signal read_column(const std::string& path, const std::string& column);

/// Mean of two signals with the same times.
Signal mean_of(const Signal& a, const Signal& b);

}  // namespace accuracy
