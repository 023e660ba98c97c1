#pragma once

#include "common.hpp"

namespace cotan::app {

void addViewCommand(Arguments& tool);

} // namespace cotan::app
