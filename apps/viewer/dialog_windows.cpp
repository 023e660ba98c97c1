#include <atomic>
#include <filesystem>
#include <thread>

#include "core/windows.hpp"
#include "dialog.hpp"
// After windows.h.
#include <commdlg.h>

namespace cotan::viewer {

namespace fs = std::filesystem;

struct SystemDialog::State {
    std::thread thread;
    std::atomic<bool> done = false;
    std::string chosen; // once done
};

SystemDialog::SystemDialog() : state_(std::make_unique<State>()) {}

// A dialog that is still open ends with the process: there is no way to close it.
SystemDialog::~SystemDialog()
{
    if (!state_->thread.joinable())
        return;
    if (state_->done)
        state_->thread.join();
    else {
        state_->thread.detach();
        (void)state_.release();
    }
}

bool SystemDialog::open() const { return state_->thread.joinable(); }

Status SystemDialog::start(const std::string& folder)
{
    State& state = *state_;
    state.done = false;
    state.chosen.clear();
    state.thread = std::thread([&state, initial = fs::path(folder)] {
        wchar_t name[32768] = L"";
        OPENFILENAMEW options{};
        options.lStructSize = sizeof options;
        options.lpstrFile = name;
        options.nMaxFile = 32768;
        options.lpstrInitialDir = initial.c_str();
        options.lpstrTitle = L"cotan view";
        options.Flags = OFN_FILEMUSTEXIST | OFN_NOCHANGEDIR | OFN_EXPLORER;
        if (::GetOpenFileNameW(&options) != 0)
            state.chosen = fs::path(name).string();
        state.done = true;
    });
    return Done{};
}

std::string SystemDialog::take()
{
    if (!state_->done)
        return {};
    state_->thread.join();
    return std::move(state_->chosen);
}

} // namespace cotan::viewer
