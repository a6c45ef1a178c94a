import { Arranging } from './arranging';
import { Building, type BuildSettings } from './building';
import { Editing } from './editing';
import { Exporting } from './exporting';
import { Facing } from './facing';
import { Inspecting } from './inspecting';
import { LiveStage } from './live_stage';
import { Measuring } from './measuring';
import type { Language } from './messages';
import { Opening } from './opening';
import { Pairing } from './pairing';
import { Projects } from './projects';
import { Sectioning } from './sectioning';
import { Setups } from './setups';
import { Store } from './store';

/** The window as its panels see it: the store, and what the parts of the window keep and do. */
export abstract class App extends Store {
  readonly projects = new Projects(this);
  readonly exporting = new Exporting(this);
  readonly inspecting = new Inspecting(this, this.exporting);
  readonly opening = new Opening(this, this.projects, this.inspecting);
  readonly arranging = new Arranging(this);
  readonly live = new LiveStage(this);
  readonly setups = new Setups(this, () => this.chooseClouds());
  readonly editing = new Editing(this, this.inspecting);
  readonly measuring = new Measuring(this, this.exporting, () =>
    this.step === 'inspect' ? this.inspecting.labels : [],
  );
  readonly sectioning = new Sectioning(this, this.exporting);
  readonly building = new Building(this, (settings) => this.build(settings));
  readonly pairing = new Pairing(this, this.inspecting);
  readonly facing = new Facing(this, this.inspecting);

  /** Whether the picture is the surface. */
  abstract get onSurface(): boolean;
  protected abstract chooseClouds(): void;
  abstract build(settings?: Partial<BuildSettings>): Promise<void>;
  abstract changeLanguage(language: Language): void;
  /** Whether the stage shows the camera instead of the scene. */
  get showsCamera(): boolean {
    if (this.step === 'rig') return Boolean(this.project.calibration?.active);
    return this.step === 'live' && this.live.layer !== 'points';
  }
  get showsResiduals(): boolean {
    return (
      this.step === 'rig' &&
      !this.project.calibration?.active &&
      Boolean(this.arranging.residuals?.maps[this.arranging.residualMap])
    );
  }
}
