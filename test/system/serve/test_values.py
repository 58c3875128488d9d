"""Known values in the planner: states, confirmations, products and reports (docs/formats/store/values.md)."""

import copy
import re

from harness import output
from planner import ServeTest, plain_store

VENDOR = {
    "label_types": {'ESL 2.9"': {"threshold": 0.002, "source": "datasheet", "order_number": "E-29", "price": 7.5}},
    "transceiver_types": {"CT/3": {"emission": {"type": "lambertian", "flux": 20}, "cost": 90, "source": "assumption"}},
}


def values(tab):
    """The values that the page was told last, by their marks."""
    told = [event["values"] for event in tab.events if "values" in event]
    return {value["mark"]: value for value in told[-1]}


def states(tab):
    return {mark: value["state"] for mark, value in values(tab).items()}


class Values(ServeTest):
    def confirm(self, tab, *marks):
        known = values(tab)
        held = tab.json.get("confirmed", {})
        confirmed = copy.deepcopy(held)
        for mark in marks:
            *way, key = [part.replace("~1", "/").replace("~0", "~") for part in mark.split("/")[1:]]
            inner = confirmed
            for part in way:
                inner = inner.setdefault(part, {})
            inner[key] = known[mark]["value"]
        op = {"path": "/confirmed", "after": confirmed} | ({"before": held} if held else {})
        self.assertNotIn("error", tab.edit(op, label="Confirm"))

    def plan(self, options=""):
        return output(f"plan store.json -o plan --samples 2096 --overwrite {options}", cwd=self.folder)

    def files(self):
        return {path.name: path.read_bytes() for path in self.folder.glob("*.json")}

    def badge(self):
        return re.search(r'class="verdict">([^<]*)<', self.text("plan/report.html"))[1]

    def test_confirmations_lapse_and_return_in_all_tabs(self):
        self.write_store(plain_store())
        server = self.serve()
        tab, other = self.open(server), self.open(server)
        self.assertEqual(
            states(tab),
            {
                "/label_types/l/threshold": "given",
                "/transceiver_types/t/emission": "given",
                "/label_types/l/responsivity": "assumed",
                "/room/height": "given",
                "/materials/w/reflectance": "given",
            },
        )
        self.confirm(tab, *values(tab))
        self.assertEqual(set(states(tab).values()), {"confirmed"})
        tab.set("/label_types/l/threshold", 0.06)
        self.assertEqual(states(tab)["/label_types/l/threshold"], "given")
        self.assertEqual(sorted(set(states(tab).values())), ["confirmed", "given"])
        tab.ask("undo")
        other.reach(tab.revision)
        self.assertEqual(set(states(other).values()), {"confirmed"}, "the mark stays while the value is another one")
        other.ask("undo")
        tab.reach(other.revision)
        self.assertNotIn("confirmed", set(states(tab).values()))
        tab.ask("redo")
        self.assertEqual(set(states(tab).values()), {"confirmed"})
        # Another program edits the file.
        self.write_store(self.document() | {"room": self.document()["room"] | {"size": [9, 6, 3.1]}})
        tab.next("changed")
        while states(tab)["/room/height"] == "confirmed":
            tab.read()
        self.assertEqual(states(tab)["/room/height"], "given")

    def test_confirmed_values_make_nothing_stale_and_renew_the_report(self):
        self.write_store(plain_store(transceiver_types={"t": {"emission": {"type": "lambertian", "flux": 60}}}))
        self.plan()
        files = {name: self.bytes(name) for name in ("plan/signal.h5", "plan/verification.csv")}
        self.assertEqual(self.badge(), "Verified for assumed values")
        tab = self.open(self.serve())
        runs = None
        while not runs:  # the first message has all, and the next have changes
            runs = (event := tab.next("plans")).get("all") or event.get("set")
        (run,) = runs
        self.assertIn("Verified for assumed values. Assumed", tab.ask("plan_details", plan=run["id"])["basis"])
        self.confirm(tab, *values(tab))
        self.assertIn("report", tab.ask("plan_report", plan=run["id"]))
        self.assertEqual(self.badge(), "Verified")
        self.assertEqual(tab.ask("plan_details", plan=run["id"])["basis"], "Verified.")
        for name, content in files.items():
            self.assertEqual(self.bytes(name), content, name)
        self.assertEqual({value["state"] for value in self.json("plan/placement.json")["values"]}, {"confirmed"})
        self.assertIn("read from plan", self.plan("--signal plan"), "the signals fit")
        self.assertEqual(self.badge(), "Verified")
        self.assertEqual(self.bytes("plan/signal.h5"), files["plan/signal.h5"])
        # The control: another threshold is another plan.
        tab.set("/label_types/l/threshold", 0.051)
        tab.ask("plan_report", plan=run["id"])
        self.assertEqual(self.badge(), "Verified", "the report is of the threshold that was confirmed")
        self.plan("--signal plan")
        self.assertEqual(self.badge(), "Verified for the values of the store file")

    def test_a_catalogue_is_added_once_and_remembered(self):
        self.write_store(plain_store())
        picture = '<svg xmlns="http://www.w3.org/2000/svg"/>'
        self.write(self.scratch / "esl.svg", picture)
        content = copy.deepcopy(VENDOR)
        content["label_types"]['ESL 2.9"']["picture"] = "esl.svg"
        vendor = self.write(self.scratch / "vendor.json", content)
        server = self.serve("--catalogue", vendor)
        self.assertEqual(self.text("esl.svg"), picture)
        tab = self.open(server)
        self.assertEqual(tab.json["catalogues"], ["vendor.json"])
        self.assertEqual([step["label"] for step in tab.history["steps"]], ["Catalogue vendor.json"])
        products = tab.project["products"]
        self.assertEqual([one["name"] for one in products["label_types"]], ['ESL 2.9"'])
        self.assertEqual((products["label_types"][0]["amount"], products["label_types"][0]["price"]), (0.002, 7.5))
        self.assertNotIn("error", tab.set("/label_types/l", {"product": 'ESL 2.9"', "safety_factor": 1.5}))
        self.assertNotIn("error", tab.set("/transceiver_types/t", {"product": "CT/3"}))
        self.assertEqual(states(tab)["/label_types/l/threshold"], "given")
        self.assertEqual(states(tab)["/transceiver_types/t/emission"], "assumed")
        self.assertEqual(states(tab)["/transceiver_types/t/cost"], "assumed")
        self.confirm(tab, *values(tab))
        self.assertEqual(set(states(tab).values()), {"confirmed"})
        tab.close()
        server.kill()
        for options in ((), ("--catalogue", vendor)):
            server = self.serve(*options)
            tab = self.open(server)
            self.assertEqual(tab.json["catalogues"], ["vendor.json"])
            self.assertEqual(set(states(tab).values()), {"confirmed"})
            self.assertEqual(tab.history["position"], 4)
            tab.close()
            server.kill()
        self.plan()
        self.assertEqual(self.json("plan/store.json")["label_types"]["l"]["name"], 'ESL 2.9"')

    def test_a_wrong_catalogue_changes_nothing(self):
        self.write_store(plain_store())
        self.write("vendor.json", {})
        clash = {"materials": {"w": {"type": "lambertian", "reflectance": 0.1}}}
        no_picture = {"label_types": {"E": {"threshold": 0.1, "picture": "missing.svg"}}}
        for name, contents in (
            ("other.json", ({"label_types": 5}, clash, no_picture)),
            ("vendor.json", (VENDOR, "{", {"fixtures": []}, [])),  # the folder has another file of this name
        ):
            for content in contents:
                before = self.files()
                line = self.refusal("--catalogue", self.write(self.scratch / name, content))
                self.assertIn("vendor.json" if name == "vendor.json" else "", line)
                self.assertEqual(self.files(), before)
