// The polar picture of a transceiver type whose emission is measured. The program reads the file.

import type { Changes } from "../changes";
import type { StoreDocument } from "../document/document";
import { valueAt, type JsonObject } from "../document/json";
import { polarPicture, type Photometry } from "../importing/polar";
import { text } from "../text";

export class ProfilePicture {
  private known: { file: string; photometry: Photometry | null } | null = null;

  constructor(
    private readonly document: StoreDocument,
    private readonly changes: Changes,
  ) {}

  /** Empty for other profiles, and until the program has answered. */
  content(type: JsonObject): Element[] {
    const file = valueAt(type, "/emission/file");
    if (typeof file !== "string") return [];
    if (this.known?.file !== file) this.ask(file);
    const photometry = this.known?.photometry;
    return photometry ? [polarPicture(photometry, text.profile.polar)] : [];
  }

  private ask(file: string): void {
    this.known = { file, photometry: null };
    void this.document.request<{ photometry?: Photometry }>("facts", { file }).then(
      ({ photometry = null }) => {
        if (this.known?.file !== file) return;
        this.known = { file, photometry: photometry as Photometry | null };
        this.changes.note("selection");
      },
      () => {}, // the problems of the store say why
    );
  }
}
