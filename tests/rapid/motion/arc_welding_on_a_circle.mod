! RAPID Instructions, ArcCStart to ArcCEnd: circles are moved, and what is left out is said.
MODULE arc_welding_on_a_circle
  CONST robtarget p1:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS welddata weld:=[10,0,[0,0,0,0,0,0,0,0,0],[0,0,0,0,0,0,0,0,0]];
  PERS seamdata seam:=[0.5,0.5,[0,0,0,0,0,0,0,0,0],0,0,0,0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0,0,[0,0,0,0,0,0,0,0,0],0.5];

  PROC main()
    MoveJ p1,v500,fine,tool0;
    ArcCStart Offs(p1,10,10,0),Offs(p1,0,20,0),v100,seam,weld,fine,tool0;     ! warning: R104
    ArcC Offs(p1,-10,30,0),Offs(p1,0,40,0),v100,seam,weld,z1,tool0;           ! warning: R104
    ArcCEnd Offs(p1,10,50,0),Offs(p1,0,60,0),v100,seam,weld,fine,tool0;       ! warning: R104
    TPWrite "end";                          ! -> end
  ENDPROC
ENDMODULE
