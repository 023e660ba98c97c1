// A command of the tool that the window runs beside itself: tool_process_posix.cpp, tool_process_windows.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cotan/result.hpp"

namespace cotan::viewer {

inline constexpr std::size_t kMaxToolOutput = 1 << 18; // bytes that are kept

// One process at a time. It and its own children end with this object.
class ToolProcess {
public:
    struct End {
        int code = -1; // exit code; negative: it crashed, or was ended
        std::string output{};
    };

    ToolProcess();
    ~ToolProcess();
    ToolProcess(const ToolProcess&) = delete;
    ToolProcess& operator=(const ToolProcess&) = delete;

    // Starts a program with these words, in the same folder. Errors: ErrorKind::unavailable.
    Status start(const std::filesystem::path& program, const std::vector<std::string>& words);
    bool running() const;      // started, and take() has not returned its end yet
    std::optional<End> take(); // once it has ended
    void stop();               // asks it to end; take() returns that soon after

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace cotan::viewer
