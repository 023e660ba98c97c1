// Instructions of a SPIR-V module.
#pragma once

#include <cstdint>
#include <span>

namespace cotan::cost {

// The instructions between OpFunction and OpFunctionEnd of all functions, without those two,
// OpLabel, OpVariable, OpLine, OpNoLine and OpNop, which do nothing. 0 for words that are no SPIR-V
// module.
int spirvInstructions(std::span<const std::uint32_t> words);

} // namespace cotan::cost
