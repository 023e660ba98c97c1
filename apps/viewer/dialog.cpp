#include "dialog.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "core/try.hpp"
#include "files.hpp"
#include "files/children.hpp"

namespace cotan::viewer {

namespace fs = std::filesystem;

namespace {

// Finds a program in PATH; empty if there is none.
std::string findProgram(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string file = folder + "/" + name; ::access(file.c_str(), X_OK) == 0)
            return file;
    return {};
}

} // namespace

Dialog::~Dialog()
{
    if (child_ > 0) {
        ::kill(child_, SIGTERM);
        waitFor(child_);
    }
    if (pipe_ >= 0)
        ::close(pipe_);
}

void Dialog::ask(Window& window, const std::string& beside)
{
    if (open())
        return;
    std::error_code error;
    folder_ = (fs::absolute(fs::path(beside.empty() ? "." : beside), error).parent_path() / "").string();
    asked_ = true;
    window.askForFile(folder_);
}

Status Dialog::startProgram()
{
    std::vector<std::string> words;
    if (const std::string zenity = findProgram("zenity"); !zenity.empty())
        words = {zenity, "--file-selection", "--title=cotan view", "--filename=" + folder_};
    else if (const std::string kdialog = findProgram("kdialog"); !kdialog.empty())
        words = {kdialog, "--getopenfilename", folder_};
    else
        return unavailableError("open: no file dialog: install zenity; or drop a file, or paste its path");
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return unavailableError("open: no file dialog: no pipe could be created");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    child_ = ::fork();
    if (child_ == 0) {
        ::dup2(ends[1], 1);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    if (child_ < 0) {
        ::close(ends[0]);
        child_ = 0;
        return unavailableError("open: no file dialog: no process could be started");
    }
    pipe_ = ends[0];
    ::fcntl(pipe_, F_SETFL, O_NONBLOCK);
    said_.clear();
    return Done{};
}

Result<std::string> Dialog::take(Window& window)
{
    if (asked_) {
        const FileAnswer answer = window.fileAnswer();
        asked_ = answer.state == FileAnswer::open;
        if (answer.state == FileAnswer::refused)
            COTAN_CHECK(startProgram());
        if (answer.state == FileAnswer::closed)
            return pathOf(answer.path);
    }
    return child_ > 0 ? takeFromProgram() : std::string();
}

std::string Dialog::takeFromProgram()
{
    char bytes[4096];
    for (ssize_t count; (count = ::read(pipe_, bytes, sizeof bytes)) > 0;)
        said_.append(bytes, std::size_t(count));
    if (waitFor(child_, /*look*/ true) == Waited::running)
        return {};
    for (ssize_t count; (count = ::read(pipe_, bytes, sizeof bytes)) > 0;)
        said_.append(bytes, std::size_t(count));
    ::close(pipe_);
    pipe_ = -1;
    child_ = 0;
    return said_.substr(0, said_.find('\n'));
}

} // namespace cotan::viewer
