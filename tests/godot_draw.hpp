// Pictures that Godot 3 draws: tests/godot is the project, these are its jobs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "run_tool.hpp"

namespace cotan::test {

// The work of one run of Godot.
class GodotJobs {
public:
    // A picture of width x height, `parts` times with the shader's uniform `part` counting from 0. Returns its number.
    // more: what tests/godot/draw.gd reads besides.
    std::size_t add(const std::string& shader, int width, int height, int parts, const nlohmann::json& more = {});

    // A texture of RGBA bytes, for `more`.
    nlohmann::json texture(const std::string& bytes, int width, int height);

    // RGB bytes of each job, rows from the top, part behind part. driver: GLES3 or GLES2. Throws std::runtime_error
    // with what Godot printed where a shader does not compile or nothing came.
    std::vector<std::string> draw(const std::string& driver);

private:
    TemporaryFolder folder_;
    nlohmann::json jobs_ = nlohmann::json::array();
    std::size_t textures_ = 0;
};

// Runs godot3 with a display of its own; throws where it printed a shader's or a script's error. What it printed.
std::string runGodot(const std::string& project, const std::string& driver, const std::string& words);

// Functions for shaders of jobs: cotan_test_unit(x), x of -1 to 1 in 24 bits of a colour; cotan_test_float(x, half),
// any float in two colours.
extern const char kGodotNumbers[];
// What these stand for. at: the colour's first byte; of floats the two colours.
double unitOfBytes(const char* at);
double floatOfBytes(const char* first, const char* second);

} // namespace cotan::test
