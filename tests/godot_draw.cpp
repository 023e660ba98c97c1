#include "godot_draw.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace cotan::test {

namespace {

double byteAt(const char* at, int k) { return static_cast<unsigned char>(at[k]); }

void store(const std::filesystem::path& file, const std::string& text)
{
    std::ofstream(file, std::ios::binary) << text;
}

} // namespace

const char kGodotNumbers[] = R"(
vec3 cotan_test_bytes(float x)
{
    float high = floor(x / 65536.0);
    float middle = floor((x - high * 65536.0) / 256.0);
    return vec3(high, middle, x - high * 65536.0 - middle * 256.0) / 255.0;
}
vec3 cotan_test_unit(float x) { return cotan_test_bytes(floor((x * 0.5 + 0.5) * 16777215.0 + 0.5)); }
vec3 cotan_test_float(float x, bool second)
{
    float size = max(abs(x), 1e-37);
    float exponent = floor(log2(size));
    float kind = x < 0.0 ? 1.0 : 0.0;
    kind = abs(x) <= 1e37 ? kind : 2.0;
    kind = abs(x) < 1e-37 ? 3.0 : kind;
    vec3 first = vec3(exponent + 127.0, kind, 0.0) / 255.0;
    return second ? cotan_test_bytes(min(floor(size * exp2(-exponent) * 4194304.0 + 0.5), 16777215.0)) : first;
}
)";

double unitOfBytes(const char* at)
{
    return (byteAt(at, 0) * 65536 + byteAt(at, 1) * 256 + byteAt(at, 2)) / 16777215 * 2 - 1;
}

double floatOfBytes(const char* first, const char* second)
{
    const double kind = byteAt(first, 1);
    if (kind == 3)
        return 0;
    if (kind == 2)
        return std::numeric_limits<double>::quiet_NaN();
    const double mantissa = (byteAt(second, 0) * 65536 + byteAt(second, 1) * 256 + byteAt(second, 2)) / 4194304;
    return (kind == 1 ? -1 : 1) * mantissa * std::exp2(byteAt(first, 0) - 127);
}

std::size_t GodotJobs::add(const std::string& shader, int width, int height, int parts, const nlohmann::json& more)
{
    const std::string name = folder_ / std::to_string(jobs_.size());
    store(name + ".shader", shader);
    nlohmann::json job{{"shader", name + ".shader"},
                       {"out", name + ".out"},
                       {"size", {width, height}},
                       {"parts", parts},
                       {"textures", nlohmann::json::object()},
                       {"mirrored", false},
                       {"scale", {1, 1, 1}},
                       {"light", nlohmann::json::array()}};
    if (more.is_object())
        job.update(more);
    jobs_.push_back(job);
    return jobs_.size() - 1;
}

nlohmann::json GodotJobs::texture(const std::string& bytes, int width, int height)
{
    const std::string name = folder_ / ("texture" + std::to_string(textures_++));
    store(name, bytes);
    return {{"file", name}, {"width", width}, {"height", height}};
}

std::vector<std::string> GodotJobs::draw(const std::string& driver)
{
    store(folder_ / "jobs.json", jobs_.dump());
    const std::string project = COTAN_SOURCE_DIR "/tests/godot" + std::string(isGodot4(driver) ? "4" : ""),
                      printed = runGodot(project, driver, "--folder='" + folder_.path().string() + "'");
    std::vector<std::string> images;
    for (const nlohmann::json& job : jobs_) {
        images.push_back(readWhole(job["out"].get<std::string>()));
        const std::size_t bytes =
            job["size"][0].get<std::size_t>() * job["size"][1].get<std::size_t>() * job["parts"].get<std::size_t>() * 3;
        if (images.back().size() != bytes)
            throw std::runtime_error("no picture of " + job["shader"].get<std::string>() + ": " + printed);
    }
    return images;
}

std::string runGodot(const std::string& project, const std::string& driver, const std::string& words)
{
    TemporaryFolder home;
    const std::string h = home.path().string();
    const std::string program = driver == "opengl3"
        ? "godot --rendering-method gl_compatibility --rendering-driver opengl3"
        : driver == "vulkan" ? "godot --rendering-method forward_plus --rendering-driver vulkan"
                             : "godot3 --video-driver " + driver;
    const std::string line = "env LC_ALL=C.UTF-8 LIBGL_ALWAYS_SOFTWARE=1 HOME='" + h + "' XDG_DATA_HOME='" + h
        + "' XDG_CONFIG_HOME='" + h + "' XDG_CACHE_HOME='" + h + "' timeout 200 xvfb-run -a -s '-screen 0 640x480x24' "
        + program + " --path '" + project + "' --audio-driver Dummy " + (isGodot4(driver) ? "-- " : "") + words + " > '"
        + h + "/log' 2>&1";
    const bool ran = std::system(line.c_str()) == 0;
    const std::string printed = readWhole(home / "log");
    std::string wrong = ran ? "" : "it failed";
    std::istringstream lines(printed); // it contains shaders that do not compile, from their first line to their last
    for (std::string text; std::getline(lines, text);)
        if (text.find("SHADER ERROR") != std::string::npos || text.find("SCRIPT ERROR") != std::string::npos)
            wrong += '\n' + text;
    if (!wrong.empty())
        throw std::runtime_error(driver + ": " + wrong);
    return printed;
}

} // namespace cotan::test
