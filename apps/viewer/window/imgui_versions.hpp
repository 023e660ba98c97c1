// Differences between versions of Dear ImGui's Vulkan backend, from Debian 12's 1.86 on.
#pragma once

#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <mutex>

namespace cotan::viewer {

// Gives the backend Vulkan's functions where it is not linked to the loader.
template<class Load> void giveImGuiFunctions([[maybe_unused]] Load load)
{
#ifdef IMGUI_IMPL_VULKAN_NO_PROTOTYPES
    ImGui_ImplVulkan_LoadFunctions([](const char* name, void* given) { return (*static_cast<Load*>(given))(name); },
                                   &load);
#endif
}

// Starts the backend with a single-sampled render pass. Some versions of `info` have no field for it.
template<class Info> bool startImGuiBackend(Info info, VkRenderPass pass)
{
    if constexpr (requires { info.PipelineInfoMain.RenderPass; }) { // 1.92.4
        info.PipelineInfoMain.RenderPass = pass;
        info.PipelineInfoMain.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
        return ImGui_ImplVulkan_Init(&info);
    } else {
        info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
        if constexpr (requires { info.RenderPass; }) { // 1.90.3
            info.RenderPass = pass;
            return ImGui_ImplVulkan_Init(&info);
        } else {
            return ImGui_ImplVulkan_Init(&info, pass);
        }
    }
}

// Builds the fonts for the next frame. From 1.92 on the backend creates font textures on demand; the flag announces
// that before the backend starts.
inline void buildImGuiFonts()
{
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 19200
    io.Fonts->Build();
#else
    io.BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
#endif
}

// Uploads the fonts. submit: before 1.90, called with a function that records into a command buffer; it must run the
// buffer and wait. From 1.90 on the backend submits by itself, to a queue that `inUse` guards; from 1.92 on it does so
// while it draws.
template<class Submit>
void uploadImGuiFonts([[maybe_unused]] const Submit& submit, [[maybe_unused]] std::recursive_mutex& inUse)
{
#if IMGUI_VERSION_NUM < 19000
    submit([](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
#elif IMGUI_VERSION_NUM < 19200
    const std::lock_guard lock(inUse);
    ImGui_ImplVulkan_CreateFontsTexture();
#endif
}

// Draw lists built before the backend started name no texture, but from 1.87 on the backend binds what they name. Sets
// the font texture.
inline void nameImGuiTexture([[maybe_unused]] ImDrawData& data)
{
#if IMGUI_VERSION_NUM < 19200
    for (int i = 0; i < data.CmdListsCount; ++i)
        for (ImDrawCmd& command : data.CmdLists[i]->CmdBuffer)
            if (!command.TextureId)
                command.TextureId = ImGui::GetIO().Fonts->TexID;
#endif
}

} // namespace cotan::viewer
