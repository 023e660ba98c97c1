// Makes the plugin's folder of shaders known as /Plugin/Cotan, before shaders are compiled.
#include "Interfaces/IPluginManager.h"
#include "Misc/Paths.h"
#include "Modules/ModuleManager.h"
#include "ShaderCore.h"

class FCotanModule : public IModuleInterface {
public:
    void StartupModule() override
    {
        const FString folder = IPluginManager::Get().FindPlugin(TEXT("Cotan"))->GetBaseDir();
        AddShaderSourceDirectoryMapping(TEXT("/Plugin/Cotan"), FPaths::Combine(folder, TEXT("Shaders")));
    }
};

IMPLEMENT_MODULE(FCotanModule, Cotan)
