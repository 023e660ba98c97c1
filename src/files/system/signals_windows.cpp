#include <atomic>

#include "core/windows.hpp"
#include "files/system/signals.hpp"

namespace cotan {

namespace {

constexpr DWORD kEndedByControl = 0xC000013A; // STATUS_CONTROL_C_EXIT, as without a handler

std::atomic<void (*)(int)> caught = nullptr;

// Runs on a thread of its own, which the system starts. Event 0 is Ctrl-C: our numbers begin at 1.
BOOL WINAPI onEvent(DWORD event)
{
    if (auto* const handler = caught.load())
        handler(int(event) + 1);
    return TRUE;
}

} // namespace

void catchSignals(void (*handler)(int))
{
    caught = handler;
    ::SetConsoleCtrlHandler(onEvent, TRUE);
}

void removeInHandler(const wchar_t* file) { ::DeleteFileW(file); }

void waitInHandler() { ::Sleep(5); }

void endBySignal(int) { ::TerminateProcess(::GetCurrentProcess(), kEndedByControl); }

} // namespace cotan
