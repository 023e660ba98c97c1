// Instructions of a SPIR-V module.
#pragma once

#include <cstdint>
#include <span>

namespace cotan::cost {

// Number of instructions between OpFunction and OpFunctionEnd of all functions, without OpLabel, OpVariable, OpLine,
// OpNoLine and OpNop, which do nothing. 0 if the words are no SPIR-V module.
int spirvInstructions(std::span<const std::uint32_t> words);

} // namespace cotan::cost
