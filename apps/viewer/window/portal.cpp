#include "portal.hpp"

#include <utility>

#ifdef COTAN_WITH_PORTAL
#include <systemd/sd-bus.h>
#endif

namespace cotan::viewer {

#ifdef COTAN_WITH_PORTAL

namespace {

constexpr const char* kName = "org.freedesktop.portal.Desktop";
constexpr std::uint64_t kPatience = 5'000'000; // timeout in microseconds; the portal may have to start first

} // namespace

struct Portal::Work {
    sd_bus* bus = nullptr;
    FileAnswer now;

    ~Work() { sd_bus_close_unref(bus); }

    // The reply to the call itself: the dialog opens, or there is no portal.
    static int replied(sd_bus_message* message, void* work, sd_bus_error*)
    {
        if (sd_bus_message_is_method_error(message, nullptr))
            static_cast<Work*>(work)->now.state = FileAnswer::refused;
        return 0;
    }

    // The Response signal: uint32 response, 0 if a file was chosen; a{sv} with "uris".
    static int responded(sd_bus_message* message, void* work, sd_bus_error*)
    {
        FileAnswer& now = static_cast<Work*>(work)->now;
        now.state = FileAnswer::closed;
        std::uint32_t response = 1;
        if (sd_bus_message_read(message, "u", &response) < 0 || response != 0
            || sd_bus_message_enter_container(message, 'a', "{sv}") < 0)
            return 0;
        while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
            const char* key = "";
            if (sd_bus_message_read(message, "s", &key) < 0)
                return 0;
            if (std::string(key) == "uris") {
                const char* uri = nullptr;
                if (sd_bus_message_enter_container(message, 'v', "as") > 0
                    && sd_bus_message_enter_container(message, 'a', "s") > 0
                    && sd_bus_message_read(message, "s", &uri) > 0)
                    now.path = uri;
                return 0;
            }
            if (sd_bus_message_skip(message, "v") < 0 || sd_bus_message_exit_container(message) < 0)
                return 0;
        }
        return 0;
    }

    int call(const std::string& folder)
    {
        sd_bus_message* message = nullptr;
        int code = sd_bus_message_new_method_call(bus, &message, kName, "/org/freedesktop/portal/desktop",
                                                  "org.freedesktop.portal.FileChooser", "OpenFile");
        if (code >= 0)
            code = sd_bus_message_append(message, "ss", "", "cotan view");
        if (code >= 0)
            code = sd_bus_message_open_container(message, 'a', "{sv}");
        if (code >= 0)
            code = sd_bus_message_open_container(message, 'e', "sv");
        if (code >= 0)
            code = sd_bus_message_append(message, "s", "current_folder");
        if (code >= 0)
            code = sd_bus_message_open_container(message, 'v', "ay");
        if (code >= 0)
            code = sd_bus_message_append_array(message, 'y', folder.c_str(), folder.size() + 1); // with the final 0
        for (int i = 0; i < 3 && code >= 0; ++i)
            code = sd_bus_message_close_container(message);
        if (code >= 0)
            code = sd_bus_call_async(bus, nullptr, message, replied, this, kPatience);
        sd_bus_message_unref(message);
        return code;
    }

    int open()
    {
        if (bus)
            return 0;
        if (const int code = sd_bus_open_user(&bus); code < 0)
            return code;
        return sd_bus_match_signal_async(bus, nullptr, kName, nullptr, "org.freedesktop.portal.Request", "Response",
                                         responded, nullptr, this);
    }
};

Portal::Portal() : work_(std::make_unique<Work>()) {}
Portal::~Portal() = default;

void Portal::ask(const std::string& folder)
{
    work_->now = {FileAnswer::open, {}};
    if (work_->open() < 0 || work_->call(folder) < 0)
        work_->now.state = FileAnswer::refused;
}

FileAnswer Portal::answer()
{
    if (work_->now.state != FileAnswer::open)
        return std::exchange(work_->now, {});
    int code = 0;
    while ((code = sd_bus_process(work_->bus, nullptr)) > 0) {
    }
    if (code < 0) { // the bus is gone
        work_ = std::make_unique<Work>();
        return {FileAnswer::refused, {}};
    }
    return work_->now.state == FileAnswer::open ? work_->now : std::exchange(work_->now, {});
}

#else

struct Portal::Work {
    FileAnswer now;
};

Portal::Portal() : work_(std::make_unique<Work>()) {}
Portal::~Portal() = default;
void Portal::ask(const std::string&) { work_->now.state = FileAnswer::refused; }
FileAnswer Portal::answer() { return std::exchange(work_->now, {}); }

#endif

} // namespace cotan::viewer
