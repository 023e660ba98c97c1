// The desktop's file dialog, with a private bus and a portal on it that answers at once.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <thread>

#include <systemd/sd-bus.h>

#include "quad_model.hpp"
#include "view_window.hpp"

namespace cotan::test {
namespace {

constexpr const char* kRequest = "/org/freedesktop/portal/desktop/request/1/1";

// Implements org.freedesktop.portal.FileChooser, which answers with `uri`; an empty one: the user closed the dialog.
class FakePortal {
public:
    explicit FakePortal(std::string uri) : uri_(std::move(uri))
    {
        daemon_ = ::popen("exec dbus-daemon --session --nofork --print-address=1 2>/dev/null", "r");
        char line[1024] = {};
        if (!daemon_ || !std::fgets(line, sizeof line, daemon_))
            return;
        address_ = std::string(line).substr(0, std::string(line).find('\n'));
        static const sd_bus_vtable methods[] = {
            SD_BUS_VTABLE_START(0), SD_BUS_METHOD("OpenFile", "ssa{sv}", "o", opened, SD_BUS_VTABLE_UNPRIVILEGED),
            SD_BUS_VTABLE_END};
        sd_bus_new(&bus_);
        sd_bus_set_address(bus_, address_.c_str());
        sd_bus_set_bus_client(bus_, 1);
        sd_bus_start(bus_);
        sd_bus_add_object_vtable(bus_, nullptr, "/org/freedesktop/portal/desktop", "org.freedesktop.portal.FileChooser",
                                 methods, this);
        sd_bus_request_name(bus_, "org.freedesktop.portal.Desktop", 0);
        sd_bus_call_method(bus_, "org.freedesktop.DBus", "/org/freedesktop/DBus", "org.freedesktop.DBus",
                           "GetConnectionUnixProcessID", nullptr, &reply_, "s", "org.freedesktop.DBus");
        sd_bus_message_read(reply_, "u", &process_);
        thread_ = std::thread([this] {
            while (!ends_)
                if (sd_bus_process(bus_, nullptr) <= 0)
                    sd_bus_wait(bus_, 20'000);
        });
    }
    ~FakePortal()
    {
        ends_ = true;
        if (thread_.joinable())
            thread_.join();
        sd_bus_message_unref(reply_);
        sd_bus_flush_close_unref(bus_);
        if (process_ > 0)
            ::kill(pid_t(process_), SIGTERM);
        if (daemon_)
            ::pclose(daemon_);
    }
    const std::string& address() const { return address_; } // empty if there is no dbus-daemon
    int callCount() const { return callCount_; }

private:
    static int opened(sd_bus_message* call, void* self, sd_bus_error*)
    {
        FakePortal& portal = *static_cast<FakePortal*>(self);
        ++portal.callCount_;
        sd_bus_reply_method_return(call, "o", kRequest);
        sd_bus_message* signal = nullptr;
        sd_bus_message_new_signal(portal.bus_, &signal, kRequest, "org.freedesktop.portal.Request", "Response");
        if (portal.uri_.empty())
            sd_bus_message_append(signal, "ua{sv}", 1u, 0);
        else
            sd_bus_message_append(signal, "ua{sv}", 0u, 2, "writable", "b", 1, "uris", "as", 1, portal.uri_.c_str());
        sd_bus_message_set_destination(signal, sd_bus_message_get_sender(call));
        sd_bus_send(portal.bus_, signal, nullptr);
        sd_bus_message_unref(signal);
        return 1;
    }

    std::string uri_, address_;
    FILE* daemon_ = nullptr;
    sd_bus* bus_ = nullptr;
    sd_bus_message* reply_ = nullptr;
    std::uint32_t process_ = 0;
    std::atomic<int> callCount_ = 0;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

// Opens the dialog once on this bus and returns the report of the session.
std::string reportAfterDialog(const TemporaryFolder& folder, const std::string& bus)
{
    ::setenv("DBUS_SESSION_BUS_ADDRESS", bus.c_str(), 1);
    const ToolRun run = play(folder, "0 wait\n0 key ctrl+o\n0 wait\n0 wait\n0 do report r.txt\n", {"--size", "64x48"});
    ::setenv("DBUS_SESSION_BUS_ADDRESS", kNoBus, 1);
    EXPECT_EQ(run.code, 0) << run.err;
    return readWhole(folder / "r.txt");
}

TEST(ViewPortal, opensTheFileChosenInTheDesktopsDialog)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    write(quad(2), folder.path());
    std::filesystem::rename(folder / "quad.gltf", folder / "a quad.gltf");
    FakePortal portal("file://" + folder.path().string() + "/a%20quad.gltf");
    if (portal.address().empty())
        GTEST_SKIP() << "no dbus-daemon";
    const std::string report = reportAfterDialog(folder, portal.address());
    EXPECT_EQ(portal.callCount(), 1);
    EXPECT_EQ(lineOf(report, "model"), "a quad.gltf");
    EXPECT_EQ(lineOf(report, "problem"), "none");
}

TEST(ViewPortal, aCancelledDialogChangesNothing)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    FakePortal portal("");
    if (portal.address().empty())
        GTEST_SKIP() << "no dbus-daemon";
    const std::string report = reportAfterDialog(folder, portal.address());
    EXPECT_EQ(portal.callCount(), 1);
    EXPECT_EQ(lineOf(report, "loads"), "1 failed 0");
    EXPECT_EQ(lineOf(report, "problem"), "none");
}

TEST(ViewPortal, missingDialogProgramsAreReported)
{
    COTAN_NEEDS_DISPLAY();
    TemporaryFolder folder;
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", folder.path().c_str(), 1);
    const std::string report = reportAfterDialog(folder, kNoBus);
    ::setenv("PATH", path.c_str(), 1);
    EXPECT_NE(lineOf(report, "problem").find("zenity"), std::string::npos) << report;
}

} // namespace
} // namespace cotan::test
