// Images drawn by Godot 3 (tests/godot) and Godot 4 (tests/godot4): the jobs of these projects.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "run_tool.hpp"

namespace cotan::test {

// The drivers are GLES3 and GLES2 of Godot 3, opengl3 and vulkan of Godot 4.
inline bool isGodot4(const std::string& driver) { return driver == "opengl3" || driver == "vulkan"; }

// The jobs of one run of Godot.
class GodotJobs {
public:
    // Adds an image of width x height that is drawn `parts` times, with the shader's uniform `part` counting from 0.
    // Returns its index. more: other members that tests/godot/draw.gd reads.
    std::size_t add(const std::string& shader, int width, int height, int parts, const nlohmann::json& more = {});

    // A texture of RGBA bytes, for `more`.
    nlohmann::json texture(const std::string& bytes, int width, int height);

    // RGB bytes of each job, rows from the top, its parts one after another. Throws
    // std::runtime_error with Godot's output if a shader does not compile or an image is missing.
    std::vector<std::string> draw(const std::string& driver);

private:
    TemporaryFolder folder_;
    nlohmann::json jobs_ = nlohmann::json::array();
    std::size_t textures_ = 0;
};

// Runs Godot on its own display and returns its output; throws if that has an error of a shader or script.
std::string runGodot(const std::string& project, const std::string& driver, const std::string& words);

// Functions for shaders of jobs: cotan_test_unit(x) stores x from -1 to 1 in 24 bits of a colour; cotan_test_float(x,
// half) stores any float in two colours.
extern const char kGodotNumbers[];
// The inverse. at: the colour's first byte; floats take the two colours.
double unitOfBytes(const char* at);
double floatOfBytes(const char* first, const char* second);

} // namespace cotan::test
