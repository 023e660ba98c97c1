#include "dialog.hpp"

#include <filesystem>
#include <system_error>

#include "core/try.hpp"
#include "files.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

void Dialog::ask(Window& window, const std::string& beside)
{
    if (open())
        return;
    std::error_code error;
    folder_ = (fs::absolute(fs::path(beside.empty() ? "." : beside), error).parent_path() / "").string();
    asked_ = true;
    window.askForFile(folder_);
}

Result<std::string> Dialog::take(Window& window)
{
    if (asked_) {
        const FileAnswer answer = window.fileAnswer();
        asked_ = answer.state == FileAnswer::open;
        if (answer.state == FileAnswer::refused)
            COTAN_CHECK(system_.start(folder_));
        if (answer.state == FileAnswer::closed)
            return pathOf(answer.path);
    }
    return system_.open() ? system_.take() : std::string();
}

} // namespace cotan::viewer
