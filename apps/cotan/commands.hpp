// Adds the commands, each defined in a file of its own.
#pragma once

#include "common.hpp"

namespace cotan::app {

void addRenderCommand(Arguments& tool);
void addCompareCommand(Arguments& tool);
void addMapCommand(Arguments& tool);
void addBakeCommand(Arguments& tool);
void addTangentsCommand(Arguments& tool);
void addLintCommand(Arguments& tool);
void addConvertCommand(Arguments& tool);
void addShaderCommand(Arguments& tool);
void addBatchCommand(Arguments& tool); // runs commands of `tool`, which must outlive it

} // namespace cotan::app
