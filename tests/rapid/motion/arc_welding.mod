! RAPID Instructions, ArcL: the speed is that of the weld, the seam's times pass at both ends.
MODULE arc_welding
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS seamdata seam:=[0.5,0.3,[0,0,0,0,0,0,0,0,0],0.7,0,0,0,0,[0,0,0,0,0,0,0,0,0],0.5,0.4,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0.6];
  PERS welddata weld:=[20,0,[0,0,0,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];

  PROC main()
    VAR robtarget p;
    VAR clock watch;
    MoveAbsJ home,v500,fine,tool0;
    p:=CRobT();
    ClkStart watch;
    ArcLStart p,v100,seam,weld,fine,tool0;  ! warning: R104
    TPWrite ValToStr(Round(ClkRead(watch)\Dec:=1)); ! -> 1.1
    ClkReset watch;
    ClkStart watch;
    ArcL Offs(p,0,0,-30),v500,seam,weld,z1,tool0; ! warning: R104
    ArcLEnd Offs(p,0,0,-60),v500,seam,weld,fine,tool0; ! warning: R104
    TPWrite ValToStr(ClkRead(watch)>4.5 AND ClkRead(watch)<4.9); ! -> TRUE
  ENDPROC
ENDMODULE
