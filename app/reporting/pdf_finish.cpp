#include "app/reporting/pdf_finish.h"

#include <QFont>
#include <QHash>
#include <QRawFont>
#include <algorithm>
#include <qpdf/QPDF.hh>
#include <qpdf/QPDFPageDocumentHelper.hh>
#include <qpdf/QPDFWriter.hh>

namespace zerodrift::reporting {
namespace {

constexpr double points_per_unit = 72.0 / 96.0;
constexpr double a4_height_pt = 842.0;

QPDFObjectHandle real(double value) {
  return QPDFObjectHandle::newReal(value, 2);
}

/// "Go to this height of that page, as large as it is shown".
QPDFObjectHandle destination(const std::vector<QPDFPageObjectHelper>& pages, const PaperPlace& place) {
  auto target = QPDFObjectHandle::newArray();
  const auto page = std::min(static_cast<std::size_t>(std::max(0, place.page)), pages.size() - 1);
  target.appendItem(pages[page].getObjectHandle());
  target.appendItem(QPDFObjectHandle::newName("/XYZ"));
  target.appendItem(QPDFObjectHandle::newNull());
  target.appendItem(real(a4_height_pt - points_per_unit * place.y + 6.0));
  target.appendItem(QPDFObjectHandle::newNull());
  return target;
}

void add_links(QPDF& pdf, const std::vector<QPDFPageObjectHelper>& pages, const std::vector<PaperLink>& links) {
  for (const auto& link : links) {
    if (link.page < 0 || static_cast<std::size_t>(link.page) >= pages.size()) continue;
    auto rectangle = QPDFObjectHandle::newArray();
    for (const double value : {points_per_unit * link.from.left(), a4_height_pt - points_per_unit * link.from.bottom(),
                               points_per_unit * link.from.right(), a4_height_pt - points_per_unit * link.from.top()}) {
      rectangle.appendItem(real(value));
    }
    auto annotation = QPDFObjectHandle::newDictionary();
    annotation.replaceKey("/Type", QPDFObjectHandle::newName("/Annot"));
    annotation.replaceKey("/Subtype", QPDFObjectHandle::newName("/Link"));
    annotation.replaceKey("/Rect", rectangle);
    annotation.replaceKey("/Border", QPDFObjectHandle::parse("[0 0 0]"));
    annotation.replaceKey("/Dest", destination(pages, link.to));
    auto page = pages[static_cast<std::size_t>(link.page)].getObjectHandle();
    auto annotations = page.getKey("/Annots");
    if (!annotations.isArray()) annotations = QPDFObjectHandle::newArray();
    annotations.appendItem(pdf.makeIndirectObject(annotation));
    page.replaceKey("/Annots", annotations);
  }
}

void add_outline(QPDF& pdf, const std::vector<QPDFPageObjectHelper>& pages, const std::vector<PaperOutline>& outline) {
  if (outline.empty()) return;
  auto root = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
  std::vector<QPDFObjectHandle> items;
  for (const auto& one : outline) {
    auto item = pdf.makeIndirectObject(QPDFObjectHandle::newDictionary());
    item.replaceKey("/Title", QPDFObjectHandle::newUnicodeString(one.title.toStdString()));
    item.replaceKey("/Parent", root);
    item.replaceKey("/Dest", destination(pages, one.at));
    items.push_back(item);
  }
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) items[i].replaceKey("/Prev", items[i - 1]);
    if (i + 1 < items.size()) items[i].replaceKey("/Next", items[i + 1]);
  }
  root.replaceKey("/Type", QPDFObjectHandle::newName("/Outlines"));
  root.replaceKey("/First", items.front());
  root.replaceKey("/Last", items.back());
  root.replaceKey("/Count", QPDFObjectHandle::newInteger(static_cast<long long>(items.size())));
  pdf.getRoot().replaceKey("/Outlines", root);
  pdf.getRoot().replaceKey("/PageMode", QPDFObjectHandle::newName("/UseOutlines"));
}

/// Radicals that look like a character share its glyph, and the writer takes the first name a glyph has: 2F6C, a
/// radical, for 76EE. Whoever searches or copies the text needs the characters.
QHash<uint, uint> characters_of_radicals() {
  constexpr uint first_radical = 0x2E80;
  constexpr uint last_radical = 0x2FD5;
  constexpr uint first_character = 0x4E00;
  constexpr uint last_character = 0x9FFF;
  const QRawFont font = QRawFont::fromFont(QFont(QStringLiteral("Noto Sans CJK SC")), QFontDatabase::SimplifiedChinese);
  const auto glyphs = [&](uint from, uint to) {
    QString text;
    for (uint code = from; code <= to; ++code) text += QChar(static_cast<char16_t>(code));
    return font.glyphIndexesForString(text);
  };
  const auto characters = glyphs(first_character, last_character);
  QHash<quint32, uint> character_of;
  for (qsizetype i = 0; i < characters.size(); ++i) {
    if (characters[i] != 0) character_of.insert(characters[i], first_character + static_cast<uint>(i));
  }
  const auto radicals = glyphs(first_radical, last_radical);
  QHash<uint, uint> out;
  for (qsizetype i = 0; i < radicals.size(); ++i) {
    const auto character = character_of.constFind(radicals[i]);
    if (character != character_of.constEnd()) out.insert(first_radical + static_cast<uint>(i), *character);
  }
  return out;
}

/// The names of the glyphs ("<2F6C>" in a font's /ToUnicode) as characters.
void name_characters(QPDF& pdf) {
  QHash<uint, uint> characters;
  for (auto& object : pdf.getAllObjects()) {
    if (!object.isDictionary() || !object.hasKey("/ToUnicode")) continue;
    auto stream = object.getKey("/ToUnicode");
    if (!stream.isStream()) continue;
    const auto data = stream.getStreamData();
    std::string names(reinterpret_cast<const char*>(data->getBuffer()), data->getSize());
    bool changed = false;
    for (auto at = names.find("<2"); at != std::string::npos; at = names.find("<2", at + 1)) {
      if (at + 5 >= names.size() || names[at + 5] != '>') continue;
      bool good = false;
      const uint code = QString::fromStdString(names.substr(at + 1, 4)).toUInt(&good, 16);
      if (!good || code < 0x2E80 || code > 0x2FD5) continue;
      if (characters.isEmpty()) characters = characters_of_radicals();
      const auto character = characters.constFind(code);
      if (character == characters.constEnd()) continue;
      names.replace(at + 1, 4, QString::number(*character, 16).toUpper().toStdString());
      changed = true;
    }
    if (changed) stream.replaceStreamData(names, QPDFObjectHandle::newNull(), QPDFObjectHandle::newNull());
  }
}

/// "D:20261121093312Z" of "2026-11-21T09:33:12.437Z".
std::string pdf_date(const std::string& utc) {
  std::string digits;
  for (const char c : utc) {
    if (c >= '0' && c <= '9') digits += c;
  }
  return digits.size() < 14 ? std::string() : "D:" + digits.substr(0, 14) + "Z";
}

std::string finish(std::string_view bytes, const PdfMarks& marks) {
  QPDF pdf;
  pdf.setSuppressWarnings(true);
  pdf.processMemoryFile("report", bytes.data(), bytes.size());
  const auto pages = QPDFPageDocumentHelper(pdf).getAllPages();
  add_links(pdf, pages, marks.links);
  add_outline(pdf, pages, marks.outline);
  name_characters(pdf);
  pdf.getRoot().replaceKey("/Lang", QPDFObjectHandle::newUnicodeString(marks.language));
  pdf.getRoot().replaceKey("/ViewerPreferences", QPDFObjectHandle::parse("<< /DisplayDocTitle true >>"));
  auto info = pdf.getTrailer().getKey("/Info");
  if (info.isDictionary()) {
    const std::string date = pdf_date(marks.made_utc);
    info.removeKey("/CreationDate");
    info.removeKey("/ModDate");
    if (!date.empty()) info.replaceKey("/CreationDate", QPDFObjectHandle::newString(date));
  }
  QPDFWriter writer(pdf);
  writer.setOutputMemory();
  writer.setDeterministicID(true);
  writer.setObjectStreamMode(qpdf_o_generate);
  writer.write();
  const auto buffer = writer.getBufferSharedPointer();
  return {reinterpret_cast<const char*>(buffer->getBuffer()), buffer->getSize()};
}

}  // namespace

Result<std::string> finished_pdf(std::string_view pdf, const PdfMarks& marks, const std::filesystem::path& path) {
  try {
    return finish(pdf, marks);
  } catch (const std::exception& problem) {  // the library's way to say that it could not
    return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", problem.what()}});
  }
}

}  // namespace zerodrift::reporting
