#include "tests/architecture/folder_graph.h"

#include <algorithm>
#include <deque>
#include <set>

namespace marsview::test {
namespace {

using Graph = std::map<std::string, std::set<std::string>>;

Graph graphOf(std::span<const Include> includes)
{
    Graph graph;
    for (const Include& include : includes) {
        const std::string from = folderOf(include.file);
        const std::string to = folderOf(include.header);
        if (from != to) {
            graph[from].insert(to);
        }
    }
    return graph;
}

// The shortest way from a folder back to itself; empty if there is none. Breadth first.
std::vector<std::string> shortestCycle(const Graph& graph, const std::string& start)
{
    std::map<std::string, std::string> reached_from;
    std::deque<std::string> next{start};
    while (!next.empty()) {
        const std::string folder = next.front();
        next.pop_front();
        const auto found = graph.find(folder);
        if (found == graph.end()) {
            continue;
        }
        for (const std::string& neighbor : found->second) {
            if (neighbor == start) {
                std::vector<std::string> cycle{folder};
                while (cycle.back() != start) {
                    cycle.push_back(reached_from.at(cycle.back()));
                }
                std::reverse(cycle.begin(), cycle.end());
                return cycle;
            }
            if (reached_from.emplace(neighbor, folder).second) {
                next.push_back(neighbor);
            }
        }
    }
    return {};
}

std::set<std::string> reachableFrom(const Graph& graph, const std::string& start)
{
    std::set<std::string> reached;
    std::vector<std::string> next{start};
    while (!next.empty()) {
        const std::string folder = next.back();
        next.pop_back();
        if (const auto found = graph.find(folder); found != graph.end()) {
            for (const std::string& neighbor : found->second) {
                if (reached.insert(neighbor).second) {
                    next.push_back(neighbor);
                }
            }
        }
    }
    return reached;
}

} // namespace

std::string folderOf(const std::string& path)
{
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? std::string() : path.substr(0, slash);
}

std::vector<FolderCycle> folderCycles(std::span<const Include> includes)
{
    const Graph graph = graphOf(includes);
    std::vector<FolderCycle> cycles;
    std::set<std::string> reported; // members of groups that have a cycle in `cycles`
    for (const auto& [folder, unused] : graph) {
        if (reported.contains(folder)) {
            continue;
        }
        FolderCycle cycle{.folders = shortestCycle(graph, folder), .includes = {}};
        if (cycle.folders.empty()) {
            continue;
        }
        for (std::size_t i = 0; i < cycle.folders.size(); ++i) {
            const std::string& from = cycle.folders[i];
            const std::string& to = cycle.folders[(i + 1) % cycle.folders.size()];
            std::copy_if(includes.begin(), includes.end(), std::back_inserter(cycle.includes),
                         [&](const Include& include) {
                             return folderOf(include.file) == from &&
                                    folderOf(include.header) == to;
                         });
        }
        cycles.push_back(std::move(cycle));
        for (const std::string& other : reachableFrom(graph, folder)) {
            if (reachableFrom(graph, other).contains(folder)) {
                reported.insert(other);
            }
        }
    }
    return cycles;
}

std::map<std::string, std::size_t> crowdedFolders(std::span<const std::string> paths,
                                                  std::size_t files_max)
{
    std::map<std::string, std::size_t> files;
    for (const std::string& path : paths) {
        ++files[folderOf(path)];
    }
    std::erase_if(files, [files_max](const auto& folder) { return folder.second <= files_max; });
    return files;
}

} // namespace marsview::test
