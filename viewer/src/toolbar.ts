import { button, element } from "./dom";
import type { Stage } from "./stage";

const views: { name: string; told: string; azimuthDeg: number; elevationDeg: number }[] = [
  { name: "+X", told: "From +x", azimuthDeg: 0, elevationDeg: 0 },
  { name: "−X", told: "From −x", azimuthDeg: 180, elevationDeg: 0 },
  { name: "+Y", told: "From +y", azimuthDeg: 90, elevationDeg: 0 },
  { name: "−Y", told: "From −y", azimuthDeg: -90, elevationDeg: 0 },
  { name: "+Z", told: "From above", azimuthDeg: -90, elevationDeg: 90 },
  { name: "−Z", told: "From below", azimuthDeg: -90, elevationDeg: -90 },
];

export interface ToolActions {
  home(): void;
  measure(): void;
  picture(): void;
  link(): void;
}

/** The buttons above the cloud. The one that measures is returned: it shows whether it is on. */
export function fillToolbar(
  place: HTMLElement,
  stage: Stage,
  actions: ToolActions,
): { measure: HTMLButtonElement } {
  const group = (...buttons: HTMLElement[]) => element("div", { class: "group" }, ...buttons);
  const projection = button("Parallel", () => {
    stage.setPose({ ...stage.pose, isPerspective: !stage.pose.isPerspective });
    projection.setAttribute("aria-pressed", `${!stage.pose.isPerspective}`);
  });
  projection.setAttribute("aria-pressed", "false");
  const measure = button("Measure", actions.measure, { id: "measure", "aria-pressed": "false" });
  place.append(
    group(
      button("Fit", () => stage.fit(), { id: "fit" }),
      button("Home", actions.home),
      projection,
    ),
    group(...views.map((view) => viewButton(view, stage))),
    group(
      measure,
      button("Picture", actions.picture, { id: "picture" }),
      button("Link", actions.link, { id: "link" }),
    ),
  );
  return { measure };
}

function viewButton(
  { name, told, azimuthDeg, elevationDeg }: (typeof views)[number],
  stage: Stage,
): HTMLButtonElement {
  const show = () => {
    stage.setPose({ ...stage.pose, azimuthDeg, elevationDeg });
    stage.fit();
  };
  return button(name, show, { "aria-label": told, title: told });
}
