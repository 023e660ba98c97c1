// Interprets the numbers of a driver by the names it gives them.
#pragma once

#include "cost/machine_code.hpp"

namespace cotan::cost {

// Fills the fields of `code` from `code.all`. Fields whose value no known name matches stay empty.
void nameStatistics(StageCode& code);

} // namespace cotan::cost
