// The commands, each in a file of its own.
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
void addBatchCommand(Arguments& tool); // of the commands of `tool`, which it outlives not

} // namespace cotan::app
