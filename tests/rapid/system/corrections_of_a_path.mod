! RAPID Instructions, CorrCon: x is along the path, y the tool's z times x, z completes them.
MODULE corrections_of_a_path
  CONST robtarget p:=[[700,150,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata v:=[500,500,5000,1000];
  VAR corrdescr seam;
  VAR corrdescr height;

  PROC main()
    MoveJ p,v,fine,tool0;
    MoveL Offs(p,0,100,0),v,fine,tool0\Corr;   ! nothing is connected yet
    TPWrite ValToStr(here());                  ! -> [0,100,0]
    MoveL p,v,fine,tool0;
    CorrCon seam;
    CorrCon height;
    CorrWrite seam,[0,2,0];
    CorrWrite height,[0,0,-10];
    ! The tool points down and the path along y of the object: y of the path is x of the object.
    MoveL Offs(p,0,100,0),v,z10,tool0\Corr;    ! warning: R104
    MoveL Offs(p,0,200,0),v,fine,tool0\Corr;
    TPWrite ValToStr(here());                  ! -> [2,200,10]
    CorrDiscon seam;
    ! The programmed path turns back, however far off the robot stands.
    MoveL Offs(p,0,100,0),v,fine,tool0\Corr;
    TPWrite ValToStr(here());                  ! -> [0,100,10]
    CorrWrite height,[3,4,0];
    MoveC Offs(p,50,50,0),p,v,fine,tool0\Corr; ! warning: R104
    TPWrite ValToStr(here());                  ! -> [-3,4,0]
    CorrClear;
    MoveL p,v,fine,tool0\Corr;
    TPWrite ValToStr(here());                  ! -> [0,0,0]
  ENDPROC

  FUNC pos here()
    VAR pos now;
    now:=CPos(\Tool:=tool0\WObj:=wobj0);
    RETURN [Round(now.x-p.trans.x),Round(now.y-p.trans.y),Round(now.z-p.trans.z)];
  ENDFUNC
ENDMODULE
