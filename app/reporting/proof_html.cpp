#include "app/reporting/proof_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/sentences.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::reporting {
namespace {

using diagnosis::ChannelReport;
using diagnosis::Diagnosis;
using diagnosis::HeatMap;

std::string html_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') {
      out += "&lt;";
    } else if (c == '&') {
      out += "&amp;";
    } else {
      out += c;
    }
  }
  return out;
}

constexpr double chart_width = 820.0;
constexpr double chart_height = 150.0;

/// One series as an SVG path; at most about a point a pixel.
std::string path_of(const std::vector<double>& values, double low, double high, const char* colour) {
  std::string d;
  const std::size_t stride = std::max<std::size_t>(1, values.size() / 800);
  bool pen = false;
  for (std::size_t k = 0; k < values.size(); k += stride) {
    if (!std::isfinite(values[k])) {
      pen = false;
      continue;
    }
    const double x =
        chart_width * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(1, values.size() - 1));
    const double y = chart_height * (1.0 - (std::clamp(values[k], low, high) - low) / (high - low));
    d += fmt::format("{}{:.1f} {:.1f}", pen ? "L" : "M", x, y);
    pen = true;
  }
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.3'/>", d, colour);
}

std::string chart_of(const ChannelReport& channel) {
  std::vector<double> sorted;
  for (const double v : channel.measured) {
    if (std::isfinite(v)) sorted.push_back(v);
  }
  if (sorted.size() < 2) return "";
  std::sort(sorted.begin(), sorted.end());
  double low = sorted[sorted.size() / 200];
  double high = sorted[sorted.size() - 1 - sorted.size() / 200];
  for (const auto* series : {&channel.refitted, &channel.explained}) {
    low = std::min(low, *std::min_element(series->begin(), series->end()));
    high = std::max(high, *std::max_element(series->begin(), series->end()));
  }
  const double margin = 0.05 * std::max(high - low, 1e-6);
  return fmt::format(
      "<h3>{}</h3><svg viewBox='0 0 {:g} {:g}' class='chart'>{}{}{}{}</svg><p class='small'>{:.4g} to {:.4g} {}</p>",
      html_escaped(channel.channel), chart_width, chart_height,
      path_of(channel.measured, low - margin, high + margin, "#999"),
      path_of(channel.nominal, low - margin, high + margin, "#d08a2e"),
      path_of(channel.refitted, low - margin, high + margin, "#c33"),
      path_of(channel.explained, low - margin, high + margin, "#1769aa"), low, high, channel.temperature ? "C" : "um");
}

std::string heat_of(const HeatMap& heat) {
  double largest = 1e-9;
  std::size_t columns = 0;
  for (const auto& row : heat.watts) {
    columns = std::max(columns, row.size());
    for (const double w : row) largest = std::max(largest, std::abs(w));
  }
  if (columns == 0) return "";
  const double cell_w = chart_width / static_cast<double>(columns);
  const double cell_h = chart_height / static_cast<double>(heat.watts.size());
  std::string cells;
  for (std::size_t i = 0; i < heat.watts.size(); ++i) {
    for (std::size_t b = 0; b < heat.watts[i].size(); ++b) {
      const double share = heat.watts[i][b] / largest;
      cells +=
          fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='{}' fill-opacity='{:.2f}'/>",
                      static_cast<double>(b) * cell_w, static_cast<double>(heat.watts.size() - 1 - i) * cell_h,
                      cell_w + 0.3, cell_h + 0.3, share > 0 ? "#c33" : "#1769aa", std::abs(share));
    }
  }
  return fmt::format(
      "<h2>Missing heat</h2><p>If all missing heat entered at one place of {} (up: towards the free end; right: time), "
      "it would "
      "be this; red is heat the simulation lacks, blue is heat it has too much; full colour is {:.0f} W.</p>"
      "<svg viewBox='0 0 {:g} {:g}' class='chart'>{}</svg>",
      html_escaped(heat.component), largest, chart_width, chart_height, cells);
}

std::string figures_of(const Diagnosis& d) {
  std::string rows;
  for (const auto& c : d.channels) {
    rows += fmt::format("<tr><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.3g}</td></tr>",
                        html_escaped(c.channel), c.rms_nominal, c.rms_refitted, c.rms_explained, c.noise);
  }
  std::string text =
      "<h2>Before and after</h2><table><tr><th>channel</th><th>nominal</th><th>re-fitted without</th>"
      "<th>with the effect</th><th>sensor noise</th></tr>" +
      rows + "</table>";
  for (const auto& other : d.held_out) {
    rows.clear();
    for (const auto& [channel, rms] : other.explained) {
      const auto at = [&name = channel](const std::map<std::string, double>& m) {
        return m.count(name) != 0 ? m.at(name) : std::nan("");
      };
      rows += fmt::format("<tr><td>{}</td><td>{:.3g}</td><td>{:.3g}</td><td>{:.3g}</td></tr>", html_escaped(channel),
                          at(other.nominal), at(other.refitted), rms);
    }
    text += "<h3>Further recording: " + html_escaped(other.recording) +
            "</h3><table><tr><th>channel</th><th>nominal</th>" +
            "<th>re-fitted without</th><th>with the effect</th></tr>" + rows + "</table>";
  }
  return text;
}

}  // namespace

std::string proof_html(const physics::Machine& machine, const Diagnosis& d) {
  std::string body = "<h1>What the simulation left out</h1><p>" + html_escaped(machine.name) + "</p>";
  for (const auto& sentence : d.sentences) body += "<p class='verdict'>" + html_escaped(sentence.english) + "</p>";
  for (const auto& effect : d.effects) {
    body += fmt::format("<div class='card'><b>{}</b> &middot; confidence {:.0f} %<p>{}</p></div>",
                        html_escaped(diagnosis::plain_name(effect.id)), 100.0 * effect.confidence,
                        html_escaped(effect.explanation.english));
  }
  for (const auto& rival : d.ambiguous_with) body += "<p>" + html_escaped(rival.why.english) + "</p>";
  if (d.suggested && !d.suggested->text.english.empty())
    body += "<p>" + html_escaped(d.suggested->text.english) + "</p>";
  body += figures_of(d);
  body += "<h2>Channels</h2><p>grey measured, orange nominal, red re-fitted without the effect, blue with it</p>";
  for (const auto& channel : d.channels) body += chart_of(channel);
  if (d.heat && d.verdict != diagnosis::Verdict::consistent) body += heat_of(*d.heat);
  if (!d.detectable.empty()) {
    body +=
        "<h2>Could have detected</h2><p>The smallest size of each effect that this recording would have shown:</p><ul>";
    for (const auto& one : d.detectable) {
      const bool never = !one.key.empty() && one.value > physics::find_effect(one.id)->parameter(one.key).high;
      std::string least = diagnosis::parameter_in_words(one.key, one.value, 0.0, one.at_rpm);
      if (least.empty()) least = fmt::format("{:.2g} W", one.value);  // of a chiller's swing
      body += fmt::format("<li>{}: {}</li>", html_escaped(diagnosis::plain_name(one.id)),
                          html_escaped(never ? "-" : least));
    }
    body += "</ul>";
  }
  return "<!doctype html><html><head><meta charset='utf-8'><title>Zerodrift diagnosis</title><style>"
         "body{font:15px sans-serif;max-width:860px;margin:2em auto;color:#222}table{border-collapse:collapse}"
         "td,th{border:1px solid #ccc;padding:3px 10px;text-align:right}.card{border:1px solid #bbb;border-radius:6px;"
         "padding:10px;margin:10px 0}.verdict{font-size:1.2em}.chart{width:100%;border:1px solid "
         "#ddd}.small{color:#777}"
         "</style></head><body>" +
         body + "</body></html>\n";
}

}  // namespace zerodrift::reporting
