#include "remesh/pipeline/domain.h"

#include <utility>

namespace remesh::detail {
namespace {

PreparedSurface prepare(CleanedInput& cleaned, const CurvePlan* plan, double spacing,
                        const SizeField* sizes, int num_threads, const agvd::Progress& progress) {
    if (plan != nullptr) return {plan->network.cut.surface, spacing, num_threads, progress, sizes};
    return {std::move(cleaned.surface), spacing, num_threads, progress, sizes};
}

}  // namespace

Domain prepare_domain(CleanedInput& cleaned, std::unique_ptr<const CurvePlan> plan, double spacing,
                      const SizeField* sizes, const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    const agvd::Progress all = progress_of(Stage::Clean, options);
    const agvd::Progress progress = agvd::within(all, cleaned_fraction, 1);
    const CurvePlan* cut = plan.get();
    Domain domain{.plan = std::move(plan),
                  .prepared = prepare(cleaned, cut, spacing, sizes, options.num_threads, progress),
                  .whole = &cleaned.surface,
                  .parts = &cleaned.topology,
                  .spacing = spacing,
                  .sizes = sizes};
    if (cut != nullptr) {
        domain.parts = &cut->patches;
    } else {
        domain.whole = &domain.prepared.input();
    }
    domain.component =
        parts_of_base(domain.prepared.base, domain.parts->face_component, agvd::within(all, 1, 1));
    result.refined_faces = domain.base().num_faces();
    return domain;
}

void give_back(Domain domain, CleanedInput& cleaned, const StageContext& context) {
    if (domain.plan) return;
    cleaned.surface = agvd::build_surface(domain.whole->mesh.view(), context.options.num_threads);
}

}  // namespace remesh::detail
