#include "bench/method.h"

#include <sstream>

namespace bench {

using agvd::Engine;

std::vector<Method> methods(const MethodLists& lists) {
    std::vector<Method> result;
    for (const Engine engine : lists.engines) {
        std::ostringstream name;
        name << agvd::engine_name(engine);
        if (engine == Engine::Window) {
            for (const double error : lists.max_errors) {
                std::ostringstream text;
                text << name.str() << ' ' << error;
                result.push_back({error == 0 ? name.str() + " exact" : text.str(),
                                  {.engine = engine, .max_error = error}});
            }
        }
        if (engine == Engine::Steiner) {
            for (const int m : lists.steiner_points) {
                for (const double lambda : lists.lambdas) {
                    std::ostringstream text;
                    text << name.str() << " m=" << m;
                    if (lists.lambdas.size() > 1) text << " l=" << lambda;
                    result.push_back(
                        {text.str(), {.engine = engine, .steiner_points = m, .lambda = lambda}});
                }
            }
        }
    }
    return result;
}

std::vector<Method> on_base(std::vector<Method> methods) {
    for (Method& method : methods) {
        method.name += " base";
        method.drawing = Drawing::OnBase;
    }
    return methods;
}

}  // namespace bench
