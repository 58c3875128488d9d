"""Known values in the planner: states, confirmations, products and reports (docs/formats/store/values.md)."""

import json
import re
import subprocess

from planner import PROGRAM, NotStarted, ServeTest, plain_store

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
        confirmed = json.loads(json.dumps(held))
        for mark in marks:
            *way, key = [part.replace("~1", "/").replace("~0", "~") for part in mark.split("/")[1:]]
            inner = confirmed
            for part in way:
                inner = inner.setdefault(part, {})
            inner[key] = known[mark]["value"]
        op = {"path": "/confirmed", "after": confirmed} | ({"before": held} if held else {})
        self.assertNotIn("error", tab.edit(op, label="Confirm"))

    def plan(self, *options):
        command = [PROGRAM, "plan", "store.json", "-o", "plan", "--samples", "2096", "--overwrite", *options]
        done = subprocess.run(command, cwd=self.folder, stdout=subprocess.PIPE, text=True, check=True)
        return done.stdout

    def badge(self):
        page = (self.folder / "plan/report.html").read_text(encoding="utf-8")
        return re.search(r'class="verdict">([^<]*)<', page)[1]

    def test_confirmations_lapse_and_return_in_all_tabs(self):
        self.write(plain_store())
        server = self.start()
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
        self.write(self.document() | {"room": self.document()["room"] | {"size": [9, 6, 3.1]}})
        tab.next("changed")
        while states(tab)["/room/height"] == "confirmed":
            tab.read()
        self.assertEqual(states(tab)["/room/height"], "given")

    def test_confirmed_values_make_nothing_stale_and_renew_the_report(self):
        self.write(plain_store(transceiver_types={"t": {"emission": {"type": "lambertian", "flux": 60}}}))
        self.plan()
        files = {name: (self.folder / "plan" / name).read_bytes() for name in ("signal.h5", "verification.csv")}
        self.assertEqual(self.badge(), "Verified for assumed values")
        tab = self.open(self.start())
        while not (runs := tab.next("plans").get("set", [])):
            pass
        (run,) = runs
        self.assertIn("Verified for assumed values. Assumed", tab.ask("plan_details", plan=run["id"])["basis"])
        self.confirm(tab, *values(tab))
        self.assertIn("report", tab.ask("plan_report", plan=run["id"]))
        self.assertEqual(self.badge(), "Verified")
        self.assertEqual(tab.ask("plan_details", plan=run["id"])["basis"], "Verified.")
        for name, content in files.items():
            self.assertEqual((self.folder / "plan" / name).read_bytes(), content, name)
        placement = json.loads((self.folder / "plan/placement.json").read_text(encoding="utf-8"))
        self.assertEqual({value["state"] for value in placement["values"]}, {"confirmed"})
        self.assertIn("read from plan", self.plan("--signal", "plan"), "the signals fit")
        self.assertEqual(self.badge(), "Verified")
        self.assertEqual((self.folder / "plan/signal.h5").read_bytes(), files["signal.h5"])
        # The control: another threshold is another plan.
        tab.set("/label_types/l/threshold", 0.051)
        tab.ask("plan_report", plan=run["id"])
        self.assertEqual(self.badge(), "Verified", "the report is of the threshold that was confirmed")
        self.plan("--signal", "plan")
        self.assertEqual(self.badge(), "Verified for the values of the store file")

    def test_a_catalogue_is_added_once_and_remembered(self):
        self.write(plain_store())
        vendor = self.scratch / "vendor.json"
        picture = '<svg xmlns="http://www.w3.org/2000/svg"/>'
        (self.scratch / "esl.svg").write_text(picture, encoding="utf-8")
        content = json.loads(json.dumps(VENDOR))
        content["label_types"]['ESL 2.9"']["picture"] = "esl.svg"
        vendor.write_text(json.dumps(content), encoding="utf-8")
        server = self.start("--catalogue", vendor)
        self.assertEqual((self.folder / "esl.svg").read_text(encoding="utf-8"), picture)
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
            server = self.start(*options)
            tab = self.open(server)
            self.assertEqual(tab.json["catalogues"], ["vendor.json"])
            self.assertEqual(set(states(tab).values()), {"confirmed"})
            self.assertEqual(tab.history["position"], 4)
            tab.close()
            server.kill()
        self.plan()
        resolved = json.loads((self.folder / "plan/store.json").read_text(encoding="utf-8"))
        self.assertEqual(resolved["label_types"]["l"]["name"], 'ESL 2.9"')

    def test_a_wrong_catalogue_changes_nothing(self):
        self.write(plain_store())
        (self.folder / "vendor.json").write_text("{}", encoding="utf-8")
        vendor = self.scratch / "vendor.json"
        wrong_type, clash = {"label_types": 5}, {"materials": {"w": {"type": "lambertian", "reflectance": 0.1}}}
        no_picture = {"label_types": {"E": {"threshold": 0.1, "picture": "missing.svg"}}}
        for content in (wrong_type, clash, no_picture):
            other = self.scratch / "other.json"
            other.write_text(json.dumps(content), encoding="utf-8")
            with self.assertRaises(NotStarted) as failure:
                self.start("--catalogue", other)
            self.assertEqual(failure.exception.code, 2, failure.exception.err)
            self.assertFalse((self.folder / "other.json").exists())
            self.assertEqual(self.document(), plain_store())
        for content in (json.dumps(VENDOR), "{", '{"fixtures": []}', "[]"):
            vendor.write_text(content, encoding="utf-8")
            before = self.store.read_bytes()
            with self.assertRaises(NotStarted) as failure:
                self.start("--catalogue", vendor)
            self.assertEqual(failure.exception.code, 2, failure.exception.err)
            self.assertIn("vendor.json", failure.exception.err)
            self.assertEqual(self.store.read_bytes(), before)
            self.assertEqual((self.folder / "vendor.json").read_text(encoding="utf-8"), "{}")
