#include "files/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <cstring>
#include <utility>

#include <unistd.h>

namespace cotan {

namespace {

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU};

enum SlotState : int { slotFree, slotTaken, slotArmed };

// Fixed size, since a signal handler may neither lock nor allocate. Pages that are never touched take no memory.
struct Slot {
    std::atomic<int> state;
    char name[4096];
};
Slot slots[kMaxParts];

std::atomic<int> holdCount = 0;
std::atomic<int> pendingSignal = 0; // the signal that arrived while held; 0: none
std::atomic<bool> ending = false;   // the program is ending by a signal: no more unfinished files are created

static_assert(std::atomic<int>::is_always_lock_free);

void unlinkParts()
{
    for (Slot& slot : slots)
        if (slot.state.load() == slotArmed)
            ::unlink(slot.name);
}

// Uses only what is allowed in a signal handler. Another thread may be about to open its unfinished file, hence the
// wait and the second removal.
void end(int signal)
{
    constexpr timespec kOpening{0, 5'000'000};
    ending = true;
    unlinkParts();
    ::nanosleep(&kOpening, nullptr);
    unlinkParts();
    struct sigaction action {};
    action.sa_handler = SIG_DFL;
    ::sigaction(signal, &action, nullptr);
    sigset_t one;
    sigemptyset(&one);
    sigaddset(&one, signal);
    ::pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
    ::raise(signal);
}

void onSignal(int signal)
{
    pendingSignal = signal;
    if (holdCount == 0)
        end(signal);
}

} // namespace

void blockWhileEnding()
{
    while (ending)
        ::pause();
}

void removePartsOnInterrupt()
{
    for (const int signal : kSignals) {
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN)
            continue;
        struct sigaction action {};
        action.sa_handler = onSignal;
        action.sa_flags = SA_RESTART;
        sigfillset(&action.sa_mask);
        ::sigaction(signal, &action, nullptr);
    }
    ::signal(SIGPIPE, SIG_IGN);
    ::signal(SIGXFSZ, SIG_IGN);
}

InterruptsHeld::InterruptsHeld() { ++holdCount; }

InterruptsHeld::~InterruptsHeld()
{
    if (--holdCount == 0)
        if (const int signal = pendingSignal)
            end(signal);
}

GuardedPart::GuardedPart(const std::filesystem::path& file) : slot_(-1)
{
    blockWhileEnding();
    if (file.empty() || file.native().size() >= sizeof Slot::name)
        return;
    for (std::size_t i = 0; i < kMaxParts && slot_ < 0; ++i) {
        int expected = slotFree;
        if (!slots[i].state.compare_exchange_strong(expected, slotTaken))
            continue;
        std::strcpy(slots[i].name, file.c_str());
        slots[i].state = slotArmed;
        slot_ = int(i);
    }
}

GuardedPart::GuardedPart(GuardedPart&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

GuardedPart::~GuardedPart()
{
    if (slot_ >= 0)
        slots[slot_].state = slotFree;
}

} // namespace cotan
