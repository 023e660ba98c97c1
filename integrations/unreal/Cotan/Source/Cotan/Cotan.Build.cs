using UnrealBuildTool;

public class Cotan : ModuleRules
{
    public Cotan(ReadOnlyTargetRules target) : base(target)
    {
        PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
        PrivateDependencyModuleNames.AddRange(new[] { "Core", "Projects", "RenderCore" });
    }
}
