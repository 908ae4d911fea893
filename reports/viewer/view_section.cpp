#include "reports/viewer/view_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/core/label_colours.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "reports/results/columns.hpp"
#include "reports/results/format_number.hpp"
#include "reports/tables/markup.hpp"
#include "reports/viewer/mesh_payload.hpp"
#include "reports/viewer/scripts.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// What a tet takes in the page: 8.6 to 9.2 bytes in meshes of 17,000 to 76,000 tets of a knee and a brain.
constexpr double kBytesPerTet = 10;

const JobResult* first_with_mesh(const Runs& runs) {
  const auto found = std::find_if(runs.begin(), runs.end(), [](const JobResult* result) {
    return result->is_ok() && !result->mesh_file.empty();
  });
  return found == runs.end() ? nullptr : *found;
}

/// The jobs whose meshes are shown, repeats left out.
Runs shown_jobs(const std::vector<JobResult>& results, const Columns& columns) {
  Runs jobs;
  for (const std::string& row : case_names(results)) {
    for (const std::string& column : columns.names()) {
      if (const JobResult* job = first_with_mesh(columns.runs(row, column))) {
        jobs.push_back(job);
      }
    }
  }
  return jobs;
}

std::size_t elements_of(const JobResult& job) {
  const auto& count = job.figures[metrics::metric_id("elements")];
  return count && *count > 0 ? static_cast<std::size_t>(*count) : 0;
}

/// Tets that the job's mesh has at most once its elements are split; a hex gives six. Not known: as many as
/// may be.
std::size_t expected_tets(const JobResult& job, std::size_t most_tets) {
  constexpr std::size_t kTetsPerHex = 6;
  const std::size_t elements = elements_of(job);
  const auto& tets = job.figures[metrics::metric_id("counts.tets")];
  const bool is_mixed = tets && static_cast<std::size_t>(*tets) < elements;
  return elements == 0 ? most_tets : std::min(most_tets, is_mixed ? kTetsPerHex * elements : elements);
}

std::array<std::uint8_t, 3> bytes_of(const std::array<double, 3>& colour) {
  std::array<std::uint8_t, 3> bytes{};
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = static_cast<std::uint8_t>(std::lround(255 * colour[c]));
  return bytes;
}

std::string hexadecimal(const std::array<std::uint8_t, 3>& colour) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]);
  return text.data();
}

/// Names and colours of the mesh's labels, the colours as in the pictures where the image has the label.
Json labels_json(const JobResult& job, const std::vector<Label>& labels, const LabelNames& of_file) {
  LabelNames names = job.image ? job.image->names : LabelNames();
  names.add_unknown(of_file);
  const std::vector<std::int64_t> known = job.image ? job.image->labels : std::vector<std::int64_t>();
  Json list = Json::array();
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const auto found = std::find(known.begin(), known.end(), labels[n]);
    const std::size_t index =
        found == known.end() ? n + known.size() : static_cast<std::size_t>(found - known.begin());
    const NamedLabel* named = names.find(labels[n]);
    const bool has_colour = named != nullptr && named->colour;
    list.push_back(
        {{"name", names.text(labels[n])},
         {"colour", has_colour ? hexadecimal(*named->colour) : hexadecimal(bytes_of(label_colour(index)))}});
  }
  return list;
}

/// What of the mesh is shown, in a sentence.
std::string note_of(const ShownMesh& mesh, const JobResult& job, const MeshPayload& payload) {
  const std::string all = format_number(static_cast<double>(mesh.tets_of_mesh), 0);
  const bool is_split = elements_of(job) != 0 && elements_of(job) != mesh.tets_of_mesh;
  std::string note = is_split ? format_number(static_cast<double>(elements_of(job)), 0) +
                                    " elements, split into " + all + " tets"
                              : all + " tets";
  if (mesh.merged_within_mm > 0) {
    note += ", simplified for display to " + format_number(static_cast<double>(mesh.tets.size()), 0) +
            ": vertices within " + format_number(mesh.merged_within_mm, 2) +
            " mm were merged (the worst elements were not)";
  } else {
    double step = 0;
    for (const nlohmann::json& one : payload.header["step"]) {
      step = std::max(step, one.get<double>());
    }
    note += ", all shown; positions are rounded to " + format_number(step / 2, 4) + " mm";
  }
  return note + ".";
}

/// JSON that no HTML parser takes for the end of its element.
std::string script_json(const Json& json) {
  return replace_all(json.dump(-1, ' ', true, Json::error_handler_t::replace), "<", "\\u003c");
}

/// The data of the meshes in the page, and what could not be put there.
struct PageMeshes {
  Json headers = Json::array();
  std::map<std::string, std::size_t> with_digest;  ///< headers by the digests of their mesh files
  std::string data, failures;
};

/// The header and the data of a mesh file that the page does not have yet.
Json add_mesh(const fs::path& folder, const JobResult& job, std::size_t most_tets, PageMeshes& page) {
  MeshFileOptions stated;
  const ShownMesh mesh = shown_mesh(read_mesh(folder / job.mesh_file, {}, nullptr, stated), most_tets);
  if (mesh.tets.empty()) {
    throw InputError("the mesh has no elements");
  }
  MeshPayload payload = mesh_payload(mesh);
  payload.header["note"] = note_of(mesh, job, payload);
  payload.header["labels"] = labels_json(job, mesh.labels, stated.names);
  payload.header["data"] = page.headers.size();
  page.data += "<script type=\"application/octet-stream\" id=\"view-mesh-" +
               std::to_string(page.headers.size()) + "\">" + base64(payload.bytes) + "</script>\n";
  return Json(payload.header);
}

/// A header for the job; jobs whose mesh files are the same bytes share the data.
void add_job(const fs::path& folder, const JobResult& job, const Columns& columns, std::size_t most_tets,
             PageMeshes& page) {
  const auto same = page.with_digest.find(job.mesh_sha256);
  Json header = job.mesh_sha256.empty() || same == page.with_digest.end()
                    ? add_mesh(folder, job, most_tets, page)
                    : page.headers[same->second];
  header["case"] = row_name(job);
  header["mesher"] = columns.name_of(job);
  page.with_digest.try_emplace(job.mesh_sha256, page.headers.size());
  page.headers.push_back(std::move(header));
}

/// How many tets each mesh may show, by the elements of those that differ.
std::size_t most_tets(const Runs& jobs, const ViewOptions& options) {
  std::vector<std::size_t> counts;
  std::set<std::string> digests;
  for (const JobResult* job : jobs) {
    if (job->mesh_sha256.empty() || digests.insert(job->mesh_sha256).second) {
      counts.push_back(expected_tets(*job, options.most_tets));
    }
  }
  const auto total = static_cast<std::size_t>(options.megabytes * 1e6 / kBytesPerTet);
  return std::min(options.most_tets, tets_for_each(counts, total));
}

PageMeshes page_meshes(const fs::path& folder, const std::vector<JobResult>& results,
                       const ViewOptions& options) {
  const Columns columns(results);
  const Runs jobs = shown_jobs(results, columns);
  const std::size_t most = most_tets(jobs, options);
  PageMeshes page;
  for (const JobResult* job : jobs) {
    try {
      add_job(folder, *job, columns, most, page);
    } catch (const InputError& error) {
      page.failures += "<li>" + markup_text(job->id + ": " + error.what()) + "</li>\n";
    }
  }
  return page;
}

}  // namespace

std::string view_section(const fs::path& folder, const std::vector<JobResult>& results,
                         const ViewOptions& options) {
  if (!(options.megabytes > 0)) {
    return "";
  }
  if (view_script().empty()) {
    return "<p>Not in this report: the bench was built without the viewer's packages, which "
           "<code>ci/setup</code> gets "
           "from npm.</p>\n";
  }
  const PageMeshes page = page_meshes(folder, results, options);
  std::string html;
  if (!page.headers.empty()) {
    html =
        "<div id=\"view\" class=\"view\"><p>The view needs JavaScript and WebGL.</p></div>\n"
        "<script type=\"application/json\" id=\"view-meshes\">" +
        script_json(page.headers) + "</script>\n" + page.data;
  }
  return html +
         (page.failures.empty() ? "" : "<p>Not shown:</p><ul class=\"notes\">" + page.failures + "</ul>\n");
}

}  // namespace cbc3d::reports
