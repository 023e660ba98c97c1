#pragma once

#include "shader_cases.hpp"

namespace cotan::test {

// The values of the cases in Godot 3. driver: GLES3 or GLES2.
Results runGodotCases(const std::vector<Case>& cases, const std::vector<Sample>& samples, const std::string& driver);

} // namespace cotan::test
