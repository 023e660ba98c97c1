#include "files/interrupt.hpp"

#include <atomic>
#include <utility>

#include "files/system/signals.hpp"

namespace cotan {

namespace {

using Letter = std::filesystem::path::value_type;

enum SlotState : int { slotFree, slotTaken, slotArmed };

// Fixed size, since a signal handler may neither lock nor allocate. Pages that are never touched take no memory.
struct Slot {
    std::atomic<int> state;
    Letter name[4096];
};
Slot slots[kMaxParts];

std::atomic<int> holdCount = 0;
std::atomic<int> pendingSignal = 0; // the signal that arrived while held; 0: none
std::atomic<bool> ending = false;   // the program is ending by a signal: no more unfinished files are created

static_assert(std::atomic<int>::is_always_lock_free);

void removeSlots()
{
    for (Slot& slot : slots)
        if (slot.state.load() == slotArmed)
            removeInHandler(slot.name);
}

// Uses only what is allowed in a signal handler. Another thread may be about to open its unfinished file, hence the
// wait and the second removal.
void end(int signal)
{
    ending = true;
    removeSlots();
    waitInHandler();
    removeSlots();
    endBySignal(signal);
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
        waitInHandler();
}

void removePartsOnInterrupt() { catchSignals(onSignal); }

InterruptsHeld::InterruptsHeld() { ++holdCount; }

InterruptsHeld::~InterruptsHeld()
{
    if (--holdCount == 0)
        if (const int signal = pendingSignal)
            end(signal);
}

GuardedPart::GuardedPart(const std::filesystem::path& file) : slot_(-1)
{
    constexpr std::size_t kMost = sizeof Slot::name / sizeof(Letter);
    blockWhileEnding();
    if (file.empty() || file.native().size() >= kMost)
        return;
    for (std::size_t i = 0; i < kMaxParts && slot_ < 0; ++i) {
        int expected = slotFree;
        if (!slots[i].state.compare_exchange_strong(expected, slotTaken))
            continue;
        file.native().copy(slots[i].name, file.native().size());
        slots[i].name[file.native().size()] = 0;
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
