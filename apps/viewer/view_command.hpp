#pragma once

#include "common.hpp"

namespace cotan::app {

void addViewCommand(app::Arguments& tool);

} // namespace cotan::app
