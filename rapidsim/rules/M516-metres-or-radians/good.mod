MODULE example
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p10,v500,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE near_miss
  PERS wobjdata table:=[FALSE,TRUE,"",[[500,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
  PERS tooldata flange:=[TRUE,[[0,0,0],[1,0,0,0]],[0.5,[0,0,0.001],[1,0,0,0],0,0,0]];
  CONST robtarget corner:=[[0.5,0.25,0],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget home:=[[0,-1.5,1.5,0,3.14,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget here:=[[0,0,1],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home,v500,fine,flange;
    MoveL corner,v500,fine,flange\WObj:=table;
    here:=CRobT();
    MoveL here,v500,fine,flange;
    MoveL RelTool(p10,0,0,3.14159\Rz:=1.5\Rx:=3),v500,fine,flange;
    reg1:=Sin(reg2*180/pi)+Cos(90)+pi*Sin(30);
  ENDPROC
ENDMODULE
! ---
MODULE slow
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST speeddata gentle:=[1,500,5000,1000];
  CONST speeddata turning:=[0,30,0,10];
  CONST speeddata milling:=[0.5,1,0.5,1];
  PROC main()
    MoveJ p10,gentle,fine,tool0;
    MoveL Offs(p10,50,0,0),v100\V:=1.5,fine,tool0;
  ENDPROC
ENDMODULE
! ---
MODULE search
  CONST robtarget p10:=[[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR signaldi diTouch;
  ! The last pass of a search is slower than anybody moves.
  CONST speeddata crawl:=[0.25,100,5000,1000];
  PROC main()
    VAR robtarget found;
    AliasIO "diContact",diTouch;
    SearchL\PStop,diTouch,found,p10,crawl,tool0;
    SearchL\PStop,diTouch,found,p10,[0.5,100,5000,1000],tool0;
  ENDPROC
ENDMODULE
