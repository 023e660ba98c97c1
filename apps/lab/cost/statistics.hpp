// What the numbers of a driver mean, by the names that it gives them.
#pragma once

#include "cost/machine_code.hpp"

namespace cotan::cost {

// Fills the fields of `code` from `code.all`. A name that no driver is known for leaves them empty.
void nameStatistics(StageCode& code);

} // namespace cotan::cost
