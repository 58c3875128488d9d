#include "shelfbeam/report/page/page_style.hpp"

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr const char* light = R"(color-scheme:light;
--page:#f6f7f8;--card:#ffffff;--ink:#1b2228;--muted:#57626d;--line:#dde2e6;--accent:#1c5d99;
--yes:#1c5d99;--open:#8a5a00;--no:#a63200;--floor:#ffffff;--fx:#e6e9ec;--fx-f:#dcecf5;--fx-b:#bfc6cc;--fx-line:#a9b2ba;
--cand:#aab3bb;--unit:#14191e;--unit-ink:#ffffff;--edge:#5d6973;--strong:#14191e;
--m0:#8f2d00;--m1:#ee6c12;--m2:#ffcf94;--m3:#dfe5ea;--m4:#a3cbe8;--m5:#4c96d2;--m6:#0a4d91;)";

constexpr const char* dark = R"(color-scheme:dark;
--page:#111518;--card:#1a2025;--ink:#e6eaed;--muted:#9ba7b2;--line:#303940;--accent:#7db8ee;
--yes:#7db8ee;--open:#f0b95b;--no:#ff8f5e;--floor:#161b1f;--fx:#2a3239;--fx-f:#22343f;--fx-b:#48525b;--fx-line:#4b5761;
--cand:#56626c;--unit:#f5f7f9;--unit-ink:#14191e;--edge:#8996a1;--strong:#ffffff;
--m0:#ff5a1f;--m1:#ffa24d;--m2:#8a5a1e;--m3:#55606a;--m4:#37658c;--m5:#5a9fd8;--m6:#b5dcff;)";

constexpr const char* rules = R"(
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--page);color:var(--ink);line-height:1.5;font-size:16px;
 font-family:system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue","Liberation Sans",Arial,sans-serif}
main{max-width:1080px;margin:0 auto;padding:40px 24px 56px}
h1{font-size:2rem;line-height:1.2;margin:.1em 0 .5em;font-weight:650;letter-spacing:-.01em;overflow-wrap:anywhere}
h2{font-size:1.3rem;margin:0 0 .5em;font-weight:650;line-height:1.3}
h3{font-size:1rem;margin:0 0 .5em;font-weight:650}
p{margin:0 0 .8em;max-width:46em}
section{margin-top:52px}
.kicker{color:var(--muted);font-size:.9rem;margin:0}
.verdict{margin-left:.5em;padding:.1em .7em;border:1.5px solid var(--tone);border-radius:1em;color:var(--tone);font-weight:600;font-size:.8rem}
.yes{--tone:var(--yes)}.open{--tone:var(--open)}.no{--tone:var(--no)}
.answer{font-size:1.45rem;line-height:1.35;font-weight:500;max-width:44em;border-left:4px solid var(--tone);padding-left:.7em;margin-bottom:.8em}
.remark{margin-bottom:.4em}
.remark,.note,.legend{color:var(--muted);font-size:.9rem}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(160px,1fr));gap:12px;margin:28px 0 0}
.card{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:12px 14px;min-width:0}
.card dt{color:var(--muted);font-size:.82rem}
.card dd{margin:.1em 0 0;font-size:1.35rem;font-weight:600;line-height:1.25;overflow-wrap:anywhere;font-variant-numeric:tabular-nums}
.word dd{font-size:1.1rem;line-height:1.5;overflow-wrap:break-word}
.card small{display:block;font-weight:400;font-size:.82rem;color:var(--muted);margin-top:.15em}
figure{margin:0 0 28px;background:var(--card);border:1px solid var(--line);border-radius:8px;padding:14px 16px}
figcaption{font-weight:600;margin-bottom:8px}
figure .note{margin:8px 0 0}
.pair{display:grid;grid-template-columns:1fr 1fr;gap:16px}
.pair>*{min-width:0}
.pair figure{margin-bottom:14px}
svg{display:block;width:100%;height:auto}
.defs{position:absolute;width:0;height:0}
.legend{list-style:none;display:flex;flex-wrap:wrap;gap:4px 18px;margin:10px 0 0;padding:0}
.legend li{display:flex;align-items:center;gap:6px;white-space:nowrap}
.key{width:20px;height:20px;flex:none}
.scroll{overflow-x:auto;background:var(--card);border:1px solid var(--line);border-radius:8px;margin-bottom:12px}
table{border-collapse:collapse;width:100%;font-size:.9rem;font-variant-numeric:tabular-nums}
th,td{padding:7px 12px;text-align:left;white-space:nowrap;border-top:1px solid var(--line)}
thead th{border-top:0;font-weight:600;color:var(--muted);font-size:.82rem;vertical-align:bottom;white-space:normal;min-width:4.6em}
.n{text-align:right}
td.w{white-space:normal;min-width:11em}
details{margin-top:12px;background:var(--card);border:1px solid var(--line);border-radius:8px;padding:10px 14px}
summary{font-weight:600;cursor:pointer}
.serves{margin:10px 0 0;font-size:.88rem}
.serves dt{font-weight:600}
.serves span{font-weight:400;color:var(--muted)}
.serves dd{margin:0 0 10px}
.serves ul{margin:0;padding:0}
.serves li{display:inline-block;margin-right:.8em;max-width:100%;overflow-wrap:anywhere}
tr>:first-child{position:sticky;left:0;background:var(--card)}
.facts{display:grid;grid-template-columns:repeat(auto-fit,minmax(280px,1fr));gap:16px}
@media(min-width:721px){.facts:has(>:nth-child(4)){grid-template-columns:1fr 1fr}}
.facts>div{background:var(--card);border:1px solid var(--line);border-radius:8px;padding:14px 16px;min-width:0}
.facts dl{display:grid;grid-template-columns:minmax(0,1fr) minmax(0,1.2fr);gap:5px 12px;margin:0;font-size:.88rem}
.facts~h3{margin-top:1.6em}
.facts dt{color:var(--muted)}
.facts dd{margin:0;overflow-wrap:anywhere;font-variant-numeric:tabular-nums}
footer{margin-top:52px;border-top:1px solid var(--line);padding-top:14px;color:var(--muted);font-size:.85rem}
.map{--fs:13px;--fid:14px;--num:15px}
.m.half{--fs:24px;--fid:20px;--num:22px;--k:1.35}
.k{transform:scale(var(--k,1))}
text{fill:var(--ink);font-family:inherit}
.t{font-size:var(--fs,13px);fill:var(--muted)}
.strong{fill:var(--ink);font-weight:600}
.mid{text-anchor:middle}.end{text-anchor:end}
.fid{font-size:inherit;fill:var(--muted);font-weight:600}
.num{font-size:var(--num,15px);font-weight:700;fill:var(--unit-ink);text-anchor:middle;dominant-baseline:central;pointer-events:none}
.floor{fill:var(--floor);stroke:var(--edge);stroke-width:1.6}
.fx{stroke:var(--fx-line);stroke-width:.8;fill:var(--fx)}.fx-f{fill:var(--fx-f)}.fx-b{fill:var(--fx-b)}
.fx-m{stroke-width:1.6;stroke-linejoin:round;paint-order:stroke}
.cand{stroke:var(--cand);stroke-width:1;fill:none}
.tick,.axis{stroke:var(--edge);stroke-width:1}
.grid{stroke:var(--line);stroke-width:1}
.bar-full{fill:var(--edge);stroke:var(--edge)}.bar-empty{fill:none;stroke:var(--edge)}
.unit{fill:var(--unit);stroke:var(--floor);stroke-width:2.5}
.aim{stroke:var(--unit);stroke-width:5;stroke-linecap:round}
.worst{fill:none;stroke:var(--strong);stroke-width:2}
.m0,.m1{stroke:var(--strong);stroke-width:1.6;stroke-linejoin:round}.m0{fill:var(--m0)}.m1{fill:var(--m1)}
.m2{fill:var(--m2);stroke:var(--strong);stroke-width:1.4}
.m3,.m4,.m5,.m6,.g{stroke:var(--edge);stroke-width:.6}
.m3{fill:var(--m3)}.m4{fill:var(--m4)}.m5{fill:var(--m5)}.m6{fill:var(--m6)}
.gz{fill:none;stroke:var(--edge);stroke-width:1}
.hollow{fill:var(--floor);stroke:var(--strong);stroke-width:.8;pointer-events:none}
.bar{fill:var(--m5)}.short{fill:var(--m1)}
.mark{stroke:var(--strong);stroke-width:1.6;stroke-dasharray:5 3}
.equal{stroke:var(--strong);stroke-width:1.6}
.chart{--fs:13px}
.chart .strong{paint-order:stroke;stroke:var(--card);stroke-width:4;stroke-linejoin:round}
@media (max-width:1079px){
.cards{grid-template-columns:repeat(3,1fr)}
th,td{padding:7px 6px}
}
@media (max-width:720px){
main{padding:24px 14px 40px}
section{margin-top:38px}
h1{font-size:1.6rem}.answer{font-size:1.2rem}
figure{padding:10px}
.pair{grid-template-columns:1fr}
.cards{grid-template-columns:1fr 1fr}
.map,.m.half{--fs:27px;--fid:24px;--num:27px;--k:1.7}
.chart{--fs:17px}
th,td{padding:6px 9px}
}
)";

constexpr const char* paper = R"(
@media print{
@page{size:A4;margin:14mm}
html{font-size:9.5pt}
body{background:#fff;font-size:1rem;-webkit-print-color-adjust:exact;print-color-adjust:exact}
main{max-width:none;padding:0}
section{margin-top:9mm}
h2,h3,figcaption{break-after:avoid}
p,figure,.card,.facts>div,tr{break-inside:avoid}
figure,.card,.facts>div,.scroll{border-color:#c4cbd1}
.scroll{overflow:visible;break-inside:avoid}
thead{display:table-header-group}
table{font-size:8pt}
th,td{padding:1.2mm 1.6mm}
.cards{grid-template-columns:repeat(3,1fr)}
.facts{grid-template-columns:1fr 1fr}
.map{--fs:15px;--fid:15px}
.m{max-height:92mm;width:auto;max-width:100%;margin:0 auto}
.m.half{max-height:none;width:100%}
.chart{--fs:15px}
summary{list-style:none}summary::-webkit-details-marker{display:none}
details::details-content{display:block;content-visibility:visible;height:auto}
details{border-color:#c4cbd1;padding:2mm 3mm}
.serves{font-size:8pt}
figure{margin-bottom:5mm;padding:3mm 4mm}
.legend{gap:1mm 4mm;font-size:8pt;margin-top:2mm}
.key{width:4.5mm;height:4.5mm}
}
)";

}  // namespace

std::string page_style(const std::string& light_colours, const std::string& dark_colours) {
  return fmt::format(":root{{{}{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}{}}}}}{}{}",
                     light, light_colours, dark, dark_colours, rules, paper);
}

}  // namespace shelfbeam
