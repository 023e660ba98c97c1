#include <csignal>
#include <cstdlib>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "dialog.hpp"
#include "files/children.hpp"

namespace cotan::viewer {

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

struct SystemDialog::State {
    pid_t child = 0;
    int pipe = -1;
    std::string said;
};

SystemDialog::SystemDialog() : state_(std::make_unique<State>()) {}

SystemDialog::~SystemDialog()
{
    if (state_->child > 0) {
        ::kill(state_->child, SIGTERM);
        waitFor(state_->child);
    }
    if (state_->pipe >= 0)
        ::close(state_->pipe);
}

bool SystemDialog::open() const { return state_->child > 0; }

Status SystemDialog::start(const std::string& folder)
{
    std::vector<std::string> words;
    if (const std::string zenity = findProgram("zenity"); !zenity.empty())
        words = {zenity, "--file-selection", "--title=cotan view", "--filename=" + folder};
    else if (const std::string kdialog = findProgram("kdialog"); !kdialog.empty())
        words = {kdialog, "--getopenfilename", folder};
    else
        return unavailableError("open: no file dialog: install zenity; or drop a file, or paste its path");
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0)
        return unavailableError("open: no file dialog: no pipe could be created");
    std::vector<char*> arguments;
    for (std::string& word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    state_->child = ::fork();
    if (state_->child == 0) {
        ::dup2(ends[1], 1);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
    ::close(ends[1]);
    if (state_->child < 0) {
        ::close(ends[0]);
        state_->child = 0;
        return unavailableError("open: no file dialog: no process could be started");
    }
    state_->pipe = ends[0];
    ::fcntl(state_->pipe, F_SETFL, O_NONBLOCK);
    state_->said.clear();
    return Done{};
}

std::string SystemDialog::take()
{
    char bytes[4096];
    for (ssize_t count; (count = ::read(state_->pipe, bytes, sizeof bytes)) > 0;)
        state_->said.append(bytes, std::size_t(count));
    if (waitFor(state_->child, /*look*/ true) == Waited::running)
        return {};
    for (ssize_t count; (count = ::read(state_->pipe, bytes, sizeof bytes)) > 0;)
        state_->said.append(bytes, std::size_t(count));
    ::close(state_->pipe);
    state_->pipe = -1;
    state_->child = 0;
    return state_->said.substr(0, state_->said.find('\n'));
}

} // namespace cotan::viewer
