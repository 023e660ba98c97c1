#include "draw_interface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/real_number.hpp"
#include "imgui_versions.hpp"

namespace cotan::viewer {

namespace {

using Commands = std::vector<std::string>;

ImU32 colorOf(const glm::vec3& c, float alpha = 1) { return ImGui::GetColorU32(ImVec4(c.x, c.y, c.z, alpha)); }

void drawMenus(const Interface& interface, Commands& chosen)
{
    if (!ImGui::BeginMainMenuBar())
        return;
    // Menus too long for a small window scroll instead of covering their title.
    const float maxHeight = ImGui::GetIO().DisplaySize.y - 2 * ImGui::GetFrameHeight();
    for (const Menu& menu : interface.menus) {
        ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, maxHeight});
        if (!ImGui::BeginMenu(menu.title.c_str()))
            continue;
        bool open = true; // whether the submenu of the items is open
        std::string submenu;
        for (const MenuItem& item : menu.items) {
            if (item.submenu != submenu) {
                if (!submenu.empty() && open)
                    ImGui::EndMenu();
                submenu = item.submenu;
                if (!submenu.empty())
                    ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, maxHeight});
                open = submenu.empty() || ImGui::BeginMenu(submenu.c_str());
            }
            if (!open)
                continue;
            if (item.command.empty())
                ImGui::Separator();
            else if (ImGui::MenuItem(item.label.c_str(), item.key.c_str(), item.on, item.usable))
                chosen.push_back(item.command);
        }
        if (!submenu.empty() && open)
            ImGui::EndMenu();
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

constexpr ImGuiWindowFlags kPanel = ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr ImGuiWindowFlags kFixed = kPanel | ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove
    | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize;

void drawSliders(const Interface& interface, Commands& chosen)
{
    if (!interface.slidersShown || interface.sliders.empty())
        return;
    const float line = ImGui::GetFrameHeight();
    ImGui::SetNextWindowPos({line / 2, 2 * line}, ImGuiCond_Appearing);
    bool open = true;
    if (ImGui::Begin("Settings", &open, kPanel | ImGuiWindowFlags_AlwaysAutoResize))
        for (const Slider& slider : interface.sliders) {
            float value = float(slider.value);
            ImGui::SetNextItemWidth(9 * line);
            const ImGuiSliderFlags flags = slider.logarithmic ? ImGuiSliderFlags_Logarithmic : 0;
            const std::string format = "%.3g " + slider.unit;
            if (ImGui::SliderFloat(slider.label.c_str(), &value, float(slider.low), float(slider.high), format.c_str(),
                                   flags))
                chosen.push_back(slider.command + " " + textOfReal(value));
        }
    ImGui::End();
    if (!open)
        chosen.push_back("toggle settings");
}

// Returns its upper edge.
float drawStatus(const Interface& interface)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0, size.y}, ImGuiCond_Always, {0, 1});
    ImGui::SetNextWindowBgAlpha(0.75f);
    if (ImGui::Begin("##status", nullptr, kFixed | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(size.x - ImGui::GetFontSize());
        if (interface.progress >= 0)
            ImGui::TextUnformatted(interface.doing.c_str());
        if (!interface.problem.empty())
            ImGui::TextColored(interface.dark ? ImVec4(1, 0.55f, 0.4f, 1) : ImVec4(0.75f, 0.1f, 0, 1), "%s",
                               interface.problem.c_str());
        if (!interface.status.empty())
            ImGui::TextUnformatted(interface.status.c_str());
        ImGui::PopTextWrapPos();
    }
    const float top = ImGui::GetWindowPos().y;
    ImGui::End();
    if (interface.progress >= 0) { // a line along the bottom edge
        ImDrawList& over = *ImGui::GetForegroundDrawList();
        over.AddRectFilled({0, size.y - 4}, {size.x * std::min(interface.progress, 1.0f), size.y},
                           ImGui::GetColorU32(ImGuiCol_PlotHistogram));
    }
    return top;
}

void drawCard(const Interface& interface)
{
    if (interface.card.empty())
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFontSize();
    const bool right = interface.cardAt.x > size.x * 0.6f, low = interface.cardAt.y > size.y * 0.6f;
    ImGui::SetNextWindowPos({interface.cardAt.x + (right ? -line : line), interface.cardAt.y + (low ? -line : line)},
                            ImGuiCond_Always, {right ? 1.0f : 0.0f, low ? 1.0f : 0.0f});
    ImGui::SetNextWindowBgAlpha(0.8f);
    if (ImGui::Begin("##card", nullptr, kFixed | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(16 * line);
        for (const std::string& text : interface.card)
            ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

// Draws text that is readable on light and dark images.
void label(ImDrawList& list, ImVec2 at, const std::string& text, ImU32 color)
{
    for (const ImVec2 d : {ImVec2(1, 1), ImVec2(-1, 1), ImVec2(1, -1), ImVec2(-1, -1)})
        list.AddText({at.x + d.x, at.y + d.y}, IM_COL32(0, 0, 0, 200), text.c_str());
    list.AddText(at, color, text.c_str());
}

void drawLines(const Interface& interface, float scale)
{
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    for (const Line2D& line : interface.lines) {
        const ImVec2 from{line.from.x, line.from.y}, to{line.to.x, line.to.y};
        list.AddLine(from, to, IM_COL32(0, 0, 0, 160), 4 * scale);
        list.AddLine(from, to, colorOf(line.color), 2 * scale);
        const glm::vec2 d = line.to - line.from;
        const float length = std::sqrt(d.x * d.x + d.y * d.y);
        if (length > 1 && !line.label.empty()) {
            const glm::vec2 along = d / length * 7.0f * scale, across{-along.y * 0.5f, along.x * 0.5f};
            const glm::vec2 a = line.to - along + across, b = line.to - along - across;
            list.AddTriangleFilled(to, {a.x, a.y}, {b.x, b.y}, colorOf(line.color));
            label(list, {line.to.x + along.x, line.to.y + along.y - ImGui::GetFontSize() / 2}, line.label,
                  colorOf(line.color));
        }
    }
}

void drawDivider(const Interface& interface, float scale)
{
    if (interface.divider < 0)
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float x = interface.divider, middle = size.y / 2;
    list.AddLine({x, 0}, {x, size.y}, IM_COL32(0, 0, 0, 160), 3 * scale);
    list.AddLine({x, 0}, {x, size.y}, IM_COL32_WHITE, scale);
    list.AddCircleFilled({x, middle}, 9 * scale, IM_COL32(0, 0, 0, 180));
    list.AddCircle({x, middle}, 9 * scale, IM_COL32_WHITE, 0, scale);
    const float pad = ImGui::GetFontSize() / 2, y = ImGui::GetFrameHeight() + pad;
    const float width = ImGui::CalcTextSize(interface.leftName.c_str()).x;
    label(list, {x - width - pad, y}, interface.leftName, IM_COL32_WHITE);
    label(list, {x + pad, y}, interface.rightName, IM_COL32_WHITE);
}

void drawScale(const Interface& interface)
{
    if (interface.scaleBar.size() < 2)
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float line = ImGui::GetFontSize(), width = line, height = size.y / 2;
    const float left = size.x - 4.5f * line, top = (size.y - height) / 2;
    const std::size_t steps = interface.scaleBar.size() - 1;
    for (std::size_t i = 0; i < steps; ++i) {
        const float low = top + height * float(steps - i) / float(steps),
                    high = top + height * float(steps - i - 1) / float(steps);
        const ImU32 a = colorOf(interface.scaleBar[i].second), b = colorOf(interface.scaleBar[i + 1].second);
        list.AddRectFilledMultiColor({left, high}, {left + width, low}, b, b, a, a);
    }
    for (std::size_t i = 0; i <= steps; ++i) {
        const float y = top + height * float(steps - i) / float(steps) - line / 2;
        label(list, {left + 1.25f * width, y}, textOfReal(interface.scaleBar[i].first) + "\xc2\xb0", IM_COL32_WHITE);
    }
}

void drawLegend(const Interface& interface)
{
    const float line = ImGui::GetFrameHeight(), size = ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    float y = ImGui::GetIO().DisplaySize.y / 2 - line * float(interface.legend.size()) / 2;
    for (const auto& [text, color] : interface.legend) {
        list.AddRectFilled({size, y}, {2 * size, y + size}, colorOf(color));
        label(list, {2.5f * size, y}, text, IM_COL32_WHITE);
        y += line;
    }
}

// Begins a panel at the left or right border that leaves the middle of the image, where the model is, visible.
bool beginSidePanel(const std::string& title, bool left, float bottom, bool& open)
{
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float line = ImGui::GetFrameHeight(), width = std::max(10 * line, 0.27f * size.x);
    if (left)
        ImGui::SetNextWindowPos({line / 2, bottom}, ImGuiCond_Always, {0, 1});
    else
        ImGui::SetNextWindowPos({size.x - line / 2, 2 * line}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, size.y * 0.45f});
    ImGui::SetNextWindowBgAlpha(0.85f);
    return ImGui::Begin(title.c_str(), &open, kPanel | ImGuiWindowFlags_AlwaysAutoResize);
}

void drawProblemAreas(const Interface& interface, Commands& chosen)
{
    if (!interface.problemAreasShown)
        return;
    bool open = true;
    if (beginSidePanel("Problem areas", /*left*/ false, 0, open)) {
        if (interface.problemAreas.empty())
            ImGui::TextUnformatted("none found");
        const float width = ImGui::GetContentRegionAvail().x;
        int number = 0;
        for (const Choice& area : interface.problemAreas) {
            ImGui::PushID(number++);
            const float height = ImGui::CalcTextSize(area.text.c_str(), nullptr, false, width).y;
            if (ImGui::Selectable("##area", false, 0, {width, height}))
                chosen.push_back(area.command);
            ImGui::GetWindowDrawList()->AddText(ImGui::GetFont(), ImGui::GetFontSize(), ImGui::GetItemRectMin(),
                                                ImGui::GetColorU32(ImGuiCol_Text), area.text.c_str(), nullptr, width);
            ImGui::PopID();
        }
    }
    ImGui::End();
    if (!open)
        chosen.push_back("toggle hot-spots");
}

void drawResult(const Interface& interface, float bottom, Commands& chosen)
{
    if (!interface.resultShown || interface.resultLines.empty())
        return;
    bool open = true;
    if (beginSidePanel(interface.resultTitle + "###result", /*left*/ true, bottom, open)) {
        ImGui::PushTextWrapPos(0);
        for (const std::string& text : interface.resultLines)
            ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
    if (!open)
        chosen.push_back("toggle result");
}

void drawSheet(const Interface& interface)
{
    if (!interface.cheatSheet)
        return;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.92f);
    if (ImGui::Begin("##sheet", nullptr, kFixed | ImGuiWindowFlags_NoInputs)) {
        const int rows = std::max(1, int(size.y * 0.85f / ImGui::GetTextLineHeightWithSpacing()));
        const int columns = std::clamp((int(interface.sheet.size()) + rows - 1) / rows, 1, 4);
        if (ImGui::BeginTable("keys", 2 * columns, ImGuiTableFlags_SizingFixedFit)) {
            const int high = (int(interface.sheet.size()) + columns - 1) / columns;
            for (int row = 0; row < high; ++row) {
                ImGui::TableNextRow();
                for (int column = 0; column < columns; ++column) {
                    const std::size_t i = std::size_t(column * high + row);
                    if (i >= interface.sheet.size())
                        continue;
                    const auto& [keys, what] = interface.sheet[i];
                    ImGui::TableSetColumnIndex(2 * column);
                    if (keys.empty())
                        ImGui::TextDisabled("%s", what.c_str());
                    else
                        ImGui::TextColored(interface.dark ? ImVec4(0.95f, 0.75f, 0.2f, 1) : ImVec4(0.6f, 0.3f, 0, 1),
                                           "%s", keys.c_str());
                    ImGui::TableSetColumnIndex(2 * column + 1);
                    if (!keys.empty())
                        ImGui::TextUnformatted((what + "   ").c_str());
                }
            }
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

} // namespace

void setLook(bool dark, float scale)
{
    ImGuiStyle style;
    if (dark)
        ImGui::StyleColorsDark(&style);
    else
        ImGui::StyleColorsLight(&style);
    style.WindowRounding = 4;
    style.FrameRounding = 3;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
}

void setFont(float scale)
{
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    const float pixels = std::round(15 * scale);
    constexpr std::array kFonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                   "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
                                   "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                                   "/usr/share/fonts/TTF/DejaVuSans.ttf", "C:/Windows/Fonts/segoeui.ttf"};
    for (const char* file : kFonts) {
        std::error_code error;
        if (std::filesystem::exists(file, error) && fonts.AddFontFromFileTTF(file, pixels))
            break;
    }
    if (fonts.Fonts.empty()) {
        ImFontConfig config;
        config.SizePixels = pixels;
        fonts.AddFontDefault(&config);
    }
    buildImGuiFonts();
}

std::vector<std::string> drawInterface(const Interface& interface, float scale)
{
    Commands chosen;
    drawLines(interface, scale);
    drawDivider(interface, scale);
    drawScale(interface);
    drawLegend(interface);
    if (interface.shown) {
        drawMenus(interface, chosen);
        drawSliders(interface, chosen);
        drawResult(interface, drawStatus(interface) - ImGui::GetFrameHeight() / 2, chosen);
        drawProblemAreas(interface, chosen);
        drawCard(interface);
    }
    drawSheet(interface);
    return chosen;
}

} // namespace cotan::viewer
