// The window by GLFW. Dear ImGui gets the same events as the viewer, including played ones.
#include <algorithm>
#include <array>
#include <clocale>
#include <cstdlib>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#define GLFW_INCLUDE_NONE
#include <vulkan/vulkan.h>

#include <GLFW/glfw3.h>
#include <glm/common.hpp>

#include "core/named_values.hpp"
#include "core/try.hpp"
#include "draw_interface.hpp"
#include "imgui_input.hpp"
#include "portal.hpp"
#include "presenter.hpp"

namespace cotan::viewer {

namespace {

struct KeyName {
    int key;
    const char* name;
};

constexpr std::array<KeyName, 17> kKeys = {{{GLFW_KEY_SPACE, "space"},
                                            {GLFW_KEY_ESCAPE, "escape"},
                                            {GLFW_KEY_ENTER, "enter"},
                                            {GLFW_KEY_TAB, "tab"},
                                            {GLFW_KEY_BACKSPACE, "backspace"},
                                            {GLFW_KEY_INSERT, "insert"},
                                            {GLFW_KEY_DELETE, "delete"},
                                            {GLFW_KEY_RIGHT, "right"},
                                            {GLFW_KEY_LEFT, "left"},
                                            {GLFW_KEY_DOWN, "down"},
                                            {GLFW_KEY_UP, "up"},
                                            {GLFW_KEY_PAGE_UP, "pageup"},
                                            {GLFW_KEY_PAGE_DOWN, "pagedown"},
                                            {GLFW_KEY_HOME, "home"},
                                            {GLFW_KEY_END, "end"},
                                            {GLFW_KEY_KP_ENTER, "enter"},
                                            {GLFW_KEY_MENU, "menu"}}};

constexpr std::array<const char*, 3> kButtons = {"left", "right", "middle"};

// Returns an empty string for keys without a name here.
std::string nameOfKey(int key, int scancode)
{
    for (const KeyName& known : kKeys)
        if (known.key == key)
            return known.name;
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25)
        return "f" + std::to_string(key - GLFW_KEY_F1 + 1);
    if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9)
        return "kp" + std::to_string(key - GLFW_KEY_KP_0);
    const char* printed = glfwGetKeyName(key, scancode); // according to the keyboard layout
    std::string name = printed ? printed : "";
    if (name.size() == 1)
        name[0] = lowerLetter(name[0]);
    return name;
}

int keyOfName(const std::string& name)
{
    for (const KeyName& known : kKeys)
        if (known.name == name)
            return known.key;
    return name.size() == 1 && name[0] >= ' ' && name[0] <= '~' ? upperLetter(name[0]) : -1;
}

std::string heldWords(int mods)
{
    return std::string(mods & GLFW_MOD_CONTROL ? "ctrl+" : "") + (mods & GLFW_MOD_ALT ? "alt+" : "")
        + (mods & GLFW_MOD_SHIFT ? "shift+" : "");
}

std::string utf8(unsigned int code)
{
    std::string text;
    if (code < 0x80)
        text += char(code);
    else if (code < 0x800) {
        text += char(0xc0 | (code >> 6));
        text += char(0x80 | (code & 0x3f));
    } else {
        if (code >= 0x10000)
            text += char(0xf0 | (code >> 18));
        text += char(code < 0x10000 ? 0xe0 | (code >> 12) : 0x80 | ((code >> 12) & 0x3f));
        text += char(0x80 | ((code >> 6) & 0x3f));
        text += char(0x80 | (code & 0x3f));
    }
    return text;
}

std::string lastProblem()
{
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

class GlfwWindow final : public Window {
public:
    ~GlfwWindow() override
    {
        presenter_.reset();
        if (imgui_) {
            ImGui_ImplGlfw_Shutdown();
            ImGui::DestroyContext();
        }
        if (window_)
            glfwDestroyWindow(window_);
        glfwTerminate();
    }

    Status open(const WindowOptions& options)
    {
        glfwSetErrorCallback(nullptr);
#ifdef GLFW_PLATFORM // 3.4: prevents the default Wayland, on which the window is not tested
        if (!std::getenv("WAYLAND_DISPLAY") || std::getenv("DISPLAY"))
            glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
        if (!glfwInit())
            return unavailableError("view: no display: " + lastProblem());
        if (!glfwVulkanSupported())
            return unavailableError("view: Vulkan cannot present in a window: " + lastProblem());
        played_ = options.played;
        glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
        glfwWindowHint(GLFW_FOCUS_ON_SHOW, GLFW_TRUE);
        window_ = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
        if (!window_)
            return unavailableError("view: no window: " + lastProblem());
        std::setlocale(LC_NUMERIC, "C"); // GTK, which draws frames on Wayland, sets the user's; Dear ImGui reads by it
        std::uint32_t count = 0;
        const char** names = glfwGetRequiredInstanceExtensions(&count);
        auto presenter = Presenter::open(
            std::vector<const char*>(names, names + count), options, [window = window_](VkInstance instance) {
                VkSurfaceKHR surface = VK_NULL_HANDLE;
                const VkResult code = glfwCreateWindowSurface(instance, window, nullptr, &surface);
                if (code != VK_SUCCESS)
                    throw std::runtime_error("glfwCreateWindowSurface failed (" + std::to_string(code) + ")");
                return surface;
            });
        if (!presenter)
            return presenter.error();
        presenter_ = std::move(*presenter);
        listen();
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        imgui_ = true;
        ImGui::GetIO().IniFilename = nullptr; // the viewer saves its state itself
        ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        ImGui_ImplGlfw_InitForVulkan(window_, false);
        return Done{};
    }

    std::vector<Event> poll(double seconds) override
    {
        if (events_.empty() && seconds > 0)
            glfwWaitEventsTimeout(seconds);
        else
            glfwPollEvents();
        return std::exchange(events_, {});
    }

    std::vector<Event> interact(const Interface& interface, const std::vector<Event>& events) override
    {
        std::vector<Event> others;
        const auto take = [&] {
            for (std::string& command : layOut(interface))
                others.push_back({-1, EventKind::command, 0, 0, std::move(command)});
        };
        for (const Event& event : events) {
            switch (event.kind) {
            case EventKind::move:
                pointer_ = {event.x, event.y};
                take(); // updates what is under the pointer
                break;
            case EventKind::press:
            case EventKind::release: {
                const bool wasTaken = ImGui::GetIO().WantCaptureMouse;
                for (std::size_t i = 0; i < kButtons.size(); ++i)
                    if (bareWord(event) == kButtons[i])
                        buttons_[i] = event.kind == EventKind::press;
                take();
                if (event.kind == EventKind::press && wasTaken)
                    continue; // releases are for both
                break;
            }
            case EventKind::scroll:
                wheel_ = {event.x, event.y};
                take();
                break;
            case EventKind::key:
            case EventKind::keyUp: hold(event); break;
            case EventKind::text: ImGui::GetIO().AddInputCharactersUTF8(event.word.c_str()); break;
            case EventKind::resize: resize(int(event.x), int(event.y)); break;
            default: break;
            }
            const ImGuiIO& io = ImGui::GetIO();
            const bool pointer =
                event.kind == EventKind::move || event.kind == EventKind::press || event.kind == EventKind::scroll;
            const bool keys = event.kind == EventKind::key || event.kind == EventKind::text;
            if (!(pointer && io.WantCaptureMouse) && !(keys && io.WantTextInput))
                others.push_back(event);
        }
        return others;
    }

    Status show(const Interface& interface, const Shown& shown) override { return show(interface, shown, nullptr); }

    Result<Image> showAndRead(const Interface& interface, const Shown& shown) override
    {
        Image image;
        COTAN_CHECK(show(interface, shown, &image));
        if (image.width == 0)
            return unavailableError("view: the window shows nothing");
        return image;
    }

    glm::ivec2 size() const override
    {
        glm::ivec2 pixels{0};
        glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
        return pixels;
    }
    void resize(int width, int height) override
    {
        if (width < 1 || height < 1)
            return;
        glfwSetWindowSize(window_, width, height);
        for (int i = 0; i < 50 && size() != glm::ivec2(width, height); ++i) // a window manager may refuse
            glfwWaitEventsTimeout(0.01);
    }
    void setTitle(const std::string& title) override { glfwSetWindowTitle(window_, title.c_str()); }
    std::string clipboard() override
    {
        const char* text = glfwGetClipboardString(window_);
        return text ? text : "";
    }
    void setClipboard(const std::string& text) override { glfwSetClipboardString(window_, text.c_str()); }
    void askForFile(const std::string& folder) override { portal_.ask(folder); }
    FileAnswer fileAnswer() override { return portal_.answer(); }
    void loseSurface() override { presenter_->loseSurface(); }
    std::shared_ptr<Device> device() const override { return presenter_->device(); }
    std::uint64_t imagesRead() const override { return presenter_->imagesRead(); }
    void wake() override { glfwPostEmptyEvent(); }

private:
    static GlfwWindow& of(GLFWwindow* window) { return *static_cast<GlfwWindow*>(glfwGetWindowUserPointer(window)); }
    void add(EventKind kind, float x, float y, std::string word)
    {
        if (!played_ || kind == EventKind::close)
            events_.push_back({0, kind, x, y, std::move(word)});
    }

    void listen()
    {
        glfwSetWindowUserPointer(window_, this);
        glfwSetCursorPosCallback(window_, [](GLFWwindow* w, double x, double y) {
            const glm::vec2 pixels = of(w).inPixels(x, y);
            of(w).add(EventKind::move, pixels.x, pixels.y, {});
        });
        glfwSetMouseButtonCallback(window_, [](GLFWwindow* w, int button, int action, int mods) {
            if (button < int(kButtons.size()))
                of(w).add(action == GLFW_PRESS ? EventKind::press : EventKind::release, 0, 0,
                          heldWords(mods) + kButtons[std::size_t(button)]);
        });
        glfwSetScrollCallback(
            window_, [](GLFWwindow* w, double x, double y) { of(w).add(EventKind::scroll, float(x), float(y), {}); });
        glfwSetKeyCallback(window_, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
            const std::string name = nameOfKey(key, scancode);
            if (!name.empty())
                of(w).add(action == GLFW_RELEASE ? EventKind::keyUp : EventKind::key, 0, 0, heldWords(mods) + name);
        });
        glfwSetCharCallback(window_, [](GLFWwindow* w, unsigned int code) {
            if (code >= 32)
                of(w).add(EventKind::text, 0, 0, utf8(code));
        });
        glfwSetDropCallback(window_, [](GLFWwindow* w, int count, const char** paths) {
            for (int i = 0; i < count; ++i)
                of(w).add(EventKind::drop, 0, 0, paths[i]);
        });
        glfwSetWindowCloseCallback(window_, [](GLFWwindow* w) { of(w).add(EventKind::close, 0, 0, {}); });
    }

    glm::vec2 inPixels(double x, double y) const
    {
        glm::ivec2 units{1};
        glfwGetWindowSize(window_, &units.x, &units.y);
        return glm::vec2(x, y) * glm::vec2(size()) / glm::vec2(glm::max(units, glm::ivec2(1)));
    }

    void hold(const Event& event)
    {
        tellImGuiKey(keyOfName(bareWord(event)), event.kind == EventKind::key, holds(event, "ctrl"),
                     holds(event, "shift"), holds(event, "alt"));
    }

    Status show(const Interface& interface, const Shown& shown, Image* read)
    {
        try {
            for (std::string& command : layOut(interface))
                events_.push_back({-1, EventKind::command, 0, 0, std::move(command)});
            const glm::ivec2 pixels = size();
            presenter_->show(shown, ImGui::GetDrawData(), pixels.x, pixels.y, read);
            return Done{};
        } catch (const std::exception& e) {
            return unavailableError(std::string("view: ") + e.what());
        }
    }

    // Builds a frame of Dear ImGui, up to its triangles.
    std::vector<std::string> layOut(const Interface& interface)
    {
        float scale = interface.scale;
        if (scale <= 0) {
            glm::vec2 content{1};
            glfwGetWindowContentScale(window_, &content.x, &content.y);
            scale = std::clamp(content.y, 0.75f, 4.0f);
        }
        if (scale != scale_) {
            setFont(scale);
            presenter_->useFont();
        }
        if (scale != scale_ || interface.dark != dark_)
            setLook(interface.dark, scale);
        scale_ = scale;
        dark_ = interface.dark;
        ImGui_ImplGlfw_NewFrame();
        ImGuiIO& io = ImGui::GetIO();
        io.DisplaySize = {float(size().x), float(size().y)}; // all units are pixels
        io.DisplayFramebufferScale = {1, 1};
        tellImGuiPointer(pointer_, buttons_, std::exchange(wheel_, glm::vec2(0)));
        if (played_)
            io.DeltaTime = 0.05f;
        ImGui::NewFrame();
        std::vector<std::string> commands = drawInterface(interface, scale);
        ImGui::Render();
        return commands;
    }

    GLFWwindow* window_ = nullptr;
    std::unique_ptr<Presenter> presenter_;
    Portal portal_;
    std::vector<Event> events_;
    glm::vec2 pointer_{-1, -1}, wheel_{0, 0};
    std::array<bool, 3> buttons_{};
    float scale_ = 0;
    bool dark_ = true, imgui_ = false, played_ = false;
};

Result<std::unique_ptr<Window>> open(const WindowOptions& options)
{
    try {
        auto window = std::make_unique<GlfwWindow>();
        COTAN_CHECK(window->open(options));
        return std::unique_ptr<Window>(std::move(window));
    } catch (const std::exception& e) {
        return unavailableError(std::string("view: ") + e.what());
    }
}

} // namespace

} // namespace cotan::viewer

extern "C" const void* cotanWindowModule()
{
    static const cotan::viewer::WindowModule module{COTAN_MODULE_VERSION, cotan::viewer::open};
    return &module;
}
