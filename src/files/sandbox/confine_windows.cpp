#include "core/windows.hpp"
#include "files/sandbox/confine.hpp"

namespace cotan {

namespace {

// Low integrity: this process may read what its user may, and write nearly nothing.
void lowerIntegrity()
{
    SID low{SID_REVISION, 1, SECURITY_MANDATORY_LABEL_AUTHORITY, {SECURITY_MANDATORY_LOW_RID}};
    TOKEN_MANDATORY_LABEL label{{&low, SE_GROUP_INTEGRITY}};
    HANDLE token = nullptr;
    if (::OpenProcessToken(::GetCurrentProcess(), TOKEN_ADJUST_DEFAULT | TOKEN_ADJUST_PRIVILEGES, &token) == 0)
        return;
    ::AdjustTokenPrivileges(token, TRUE, nullptr, 0, nullptr, nullptr); // disables all
    ::SetTokenInformation(token, TokenIntegrityLevel, &label, sizeof label);
    ::CloseHandle(token);
}

} // namespace

void dieWith(std::int64_t, int) {} // the parent's job ends with it

void leaveNoCore() { ::SetErrorMode(SEM_FAILCRITICALERRORS | SEM_NOGPFAULTERRORBOX); }

void confine()
{
    leaveNoCore();
    lowerIntegrity();
}

void limitTo(const ReaderBudget&, const ReaderBudget&) {} // the parent looks: Child::setLimits

} // namespace cotan
